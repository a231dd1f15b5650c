-- What the analysis knows of a model's honesty beyond its leave-one-out error.
ALTER TABLE model ADD COLUMN block_rmse_dps REAL CHECK (block_rmse_dps BETWEEN 0 AND 1e6);  -- each setpoint predicted without it and its neighbours; NULL: too few
ALTER TABLE model ADD COLUMN effective_parameters REAL CHECK (effective_parameters BETWEEN 0 AND 1e6);  -- trace of d fitted / d measured; NULL: unknown
ALTER TABLE model ADD COLUMN warnings TEXT NOT NULL DEFAULT '';  -- sentences, one a line; empty: none
ALTER TABLE model_point ADD COLUMN band_dps REAL CHECK (band_dps BETWEEN 0 AND 1e6);  -- half width of the 95 % prediction band; NULL: unknown
