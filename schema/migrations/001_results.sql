CREATE TABLE analysis (  -- one pass of filter and models over a campaign's accepted dwells
  id               INTEGER PRIMARY KEY,
  campaign_id      INTEGER NOT NULL REFERENCES campaign(id),  -- what was analysed
  settings_json    TEXT NOT NULL CHECK (json_valid(settings_json)),  -- wavelet, mode, level, rule
  software_version TEXT NOT NULL,  -- of gyrocal
  UNIQUE (campaign_id, settings_json, software_version)
) STRICT;

CREATE TABLE dwell_drift (  -- zero drift of one accepted dwell and axis, before and after the filter
  analysis_id        INTEGER NOT NULL REFERENCES analysis(id) ON DELETE CASCADE,  -- with which settings
  dwell_id           INTEGER NOT NULL REFERENCES dwell(id),  -- of which samples
  axis               TEXT NOT NULL CHECK (axis IN ('x', 'y', 'z')),  -- gyro axis
  raw_mean_dps       REAL NOT NULL CHECK (abs(raw_mean_dps) < 1e6),  -- mean of the samples
  raw_sd_dps         REAL NOT NULL CHECK (raw_sd_dps BETWEEN 0 AND 1e6),  -- their standard deviation
  filtered_mean_dps  REAL NOT NULL CHECK (abs(filtered_mean_dps) < 1e6),  -- mean after the filter: the zero drift
  filtered_sd_dps    REAL NOT NULL CHECK (filtered_sd_dps BETWEEN 0 AND 1e6),  -- standard deviation after the filter
  standard_error_dps REAL CHECK (standard_error_dps BETWEEN 0 AND 1e6),  -- of the zero drift, from its own autocorrelated noise
  PRIMARY KEY (analysis_id, dwell_id, axis)
) STRICT, WITHOUT ROWID;

CREATE INDEX dwell_drift_of_dwell ON dwell_drift (dwell_id);

CREATE TABLE model (  -- zero drift over temperature for one board and axis, by one method
  id                   INTEGER PRIMARY KEY,
  analysis_id          INTEGER NOT NULL REFERENCES analysis(id) ON DELETE CASCADE,  -- settings and version
  board_id             INTEGER NOT NULL REFERENCES board(id),  -- whose drift
  axis                 TEXT NOT NULL CHECK (axis IN ('x', 'y', 'z')),  -- gyro axis
  method               TEXT NOT NULL CHECK (method <> ''),  -- gm11, improved_gm11, least_squares, ...
  parameters_json      TEXT NOT NULL CHECK (json_valid(parameters_json)),  -- all that is needed to evaluate it
  rmse_dps             REAL NOT NULL CHECK (rmse_dps BETWEEN 0 AND 1e6),  -- fitted against measured, divided by n
  rmse_n_minus_1_dps   REAL NOT NULL CHECK (rmse_n_minus_1_dps BETWEEN 0 AND 1e6),  -- divided by n - 1
  mae_dps              REAL NOT NULL CHECK (mae_dps BETWEEN 0 AND 1e6),  -- mean absolute error
  max_dps              REAL NOT NULL CHECK (max_dps BETWEEN 0 AND 1e6),  -- largest absolute error
  loocv_rmse_dps       REAL CHECK (loocv_rmse_dps BETWEEN 0 AND 1e6),  -- leave-one-out: the honest one
  recommended          INTEGER NOT NULL CHECK (recommended IN (0, 1)),  -- 1: the one to use
  reason               TEXT NOT NULL,  -- why recommended, or empty
  dwells_sha256        TEXT NOT NULL,  -- over the raw samples of the dwells used
  UNIQUE (analysis_id, board_id, axis, method)
) STRICT;

CREATE UNIQUE INDEX model_recommended ON model (analysis_id, board_id, axis) WHERE recommended = 1;
CREATE INDEX model_of_board ON model (board_id, axis);

CREATE TABLE model_dwell (  -- provenance: the dwells a model was fitted to
  model_id INTEGER NOT NULL REFERENCES model(id) ON DELETE CASCADE,  -- the model
  position INTEGER NOT NULL CHECK (position >= 0),  -- order in which they were used
  dwell_id INTEGER NOT NULL REFERENCES dwell(id),  -- the dwell
  PRIMARY KEY (model_id, position),
  UNIQUE (model_id, dwell_id)
) STRICT, WITHOUT ROWID;

CREATE INDEX model_dwell_of_dwell ON model_dwell (dwell_id);

CREATE TABLE model_point (  -- the model against what it was fitted to
  model_id      INTEGER NOT NULL REFERENCES model(id) ON DELETE CASCADE,  -- the model
  position      INTEGER NOT NULL CHECK (position >= 0),  -- order of the points
  temperature_c REAL NOT NULL CHECK (temperature_c BETWEEN -273.15 AND 1000),  -- where
  measured_dps  REAL NOT NULL CHECK (abs(measured_dps) < 1e6),  -- zero drift of the dwell
  fitted_dps    REAL NOT NULL CHECK (abs(fitted_dps) < 1e6),  -- what the model says there
  PRIMARY KEY (model_id, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE rig_model (  -- what the simulation contains: a baseline and the effects in rig_effect
  id               INTEGER PRIMARY KEY,
  name             TEXT NOT NULL CHECK (name <> ''),  -- what people call it
  sha256           TEXT NOT NULL UNIQUE,  -- of model_json: the same model is stored once
  parent_id        INTEGER REFERENCES rig_model(id),  -- the model it was made from; NULL: the first
  baseline_json    TEXT NOT NULL CHECK (json_valid(baseline_json)),  -- bias, noise, lags
  model_json       TEXT NOT NULL CHECK (json_valid(model_json)),  -- the whole model as its file holds it
  software_version TEXT NOT NULL  -- of gyrocal
) STRICT;

CREATE INDEX rig_model_of_parent ON rig_model (parent_id);

CREATE TABLE rig_effect (  -- one effect of a rig model
  rig_model_id    INTEGER NOT NULL REFERENCES rig_model(id) ON DELETE CASCADE,  -- the model
  position        INTEGER NOT NULL CHECK (position >= 0),  -- order in the model
  effect          TEXT NOT NULL CHECK (effect <> ''),  -- name in the catalogue: thermal_hysteresis
  law             TEXT NOT NULL,  -- which of its laws; empty if it has one
  parameters_json TEXT NOT NULL CHECK (json_valid(parameters_json)),  -- name to value, units as in the catalogue
  PRIMARY KEY (rig_model_id, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE diagnosis (  -- one comparison of a measured session with a rig model
  id                  INTEGER PRIMARY KEY,
  board_id            INTEGER REFERENCES board(id),  -- whose session; NULL: a session directory
  axis                TEXT NOT NULL CHECK (axis IN ('x', 'y', 'z')),  -- gyro axis
  source              TEXT NOT NULL,  -- the session as a person names it
  rig_model_before_id INTEGER NOT NULL REFERENCES rig_model(id),  -- what was compared
  rig_model_after_id  INTEGER NOT NULL REFERENCES rig_model(id),  -- with all findings added
  verdict             TEXT NOT NULL CHECK (verdict IN ('consistent', 'explained', 'unexplained', 'confounded')),  -- the outcome
  gap_before          REAL NOT NULL CHECK (gap_before BETWEEN 0 AND 1e12),  -- error bars beyond chance on kept-out data, before
  gap_after           REAL NOT NULL CHECK (gap_after BETWEEN 0 AND 1e12),  -- the same with all findings added
  report_json         TEXT NOT NULL CHECK (json_valid(report_json)),  -- gyrocal-diagnosis/1, whole
  software_version    TEXT NOT NULL  -- of gyrocal
) STRICT;

CREATE INDEX diagnosis_of_board ON diagnosis (board_id, axis);
CREATE INDEX diagnosis_of_model_before ON diagnosis (rig_model_before_id);
CREATE INDEX diagnosis_of_model_after ON diagnosis (rig_model_after_id);

CREATE TABLE finding (  -- one effect a diagnosis named
  diagnosis_id         INTEGER NOT NULL REFERENCES diagnosis(id) ON DELETE CASCADE,  -- in which diagnosis
  position             INTEGER NOT NULL CHECK (position >= 0),  -- order of finding
  effect               TEXT NOT NULL CHECK (effect <> ''),  -- name in the catalogue, or unknown
  amplitude            REAL NOT NULL CHECK (abs(amplitude) < 1e12),  -- its size
  unit                 TEXT NOT NULL,  -- unit of amplitude
  standard_error       REAL CHECK (standard_error BETWEEN 0 AND 1e12),  -- of amplitude
  parameters_json      TEXT NOT NULL CHECK (json_valid(parameters_json)),  -- the other parameters
  evidence_nats        REAL CHECK (abs(evidence_nats) < 1e12),  -- log likelihood gained on held-out data
  lead_nats            REAL CHECK (abs(lead_nats) < 1e12),  -- over the next best effect
  confounded_with_json TEXT NOT NULL CHECK (json_valid(confounded_with_json)),  -- names that explain it as well
  tell_apart           TEXT NOT NULL,  -- the observation that would decide, or empty
  description          TEXT NOT NULL,  -- a sentence
  gap_before           REAL CHECK (gap_before BETWEEN 0 AND 1e12),  -- before this effect was added
  gap_after            REAL CHECK (gap_after BETWEEN 0 AND 1e12),  -- after it was added
  PRIMARY KEY (diagnosis_id, position)
) STRICT, WITHOUT ROWID;
