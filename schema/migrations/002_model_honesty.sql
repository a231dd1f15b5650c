-- What the analysis knows of a model's honesty beyond its leave-one-out error. The comments stand
-- inside the definitions: of what follows them SQLite keeps nothing for `.schema`.
ALTER TABLE model ADD COLUMN block_rmse_dps /* each setpoint predicted without it and its neighbours; NULL: too few */ REAL CHECK (block_rmse_dps BETWEEN 0 AND 1e6);
ALTER TABLE model ADD COLUMN effective_parameters /* trace of d fitted / d measured; NULL: unknown */ REAL CHECK (effective_parameters BETWEEN 0 AND 1e6);
ALTER TABLE model ADD COLUMN warnings /* sentences, one a line; empty: none */ TEXT NOT NULL DEFAULT '';
ALTER TABLE model_point ADD COLUMN band_dps /* half width of the 95 % prediction band; NULL: unknown */ REAL CHECK (band_dps BETWEEN 0 AND 1e6);
