-- Schema version 1. Times t_ns count nanoseconds of campaign time since the campaign's start;
-- campaign.utc_start_ns says when that was. Units stand at the end of column names: c degrees
-- Celsius, k kelvin (a difference), dps degrees per second, lsb counts of the board's ADC.
-- NULL stands for "not measured". Comments stand inside the statements, so that `.schema` shows them.

CREATE TABLE campaign (  -- one run of a plan over a set of boards
  id                   INTEGER PRIMARY KEY,
  name                 TEXT NOT NULL CHECK (name <> ''),  -- as in the campaign file
  config_toml          TEXT NOT NULL,  -- the campaign file as read
  software_version     TEXT NOT NULL,  -- of gyrocal when the campaign began
  utc_start_ns         INTEGER NOT NULL,  -- when t_ns was 0: nanoseconds since 1970 in UTC; 0: unknown, an imported session
  simulated            INTEGER NOT NULL CHECK (simulated IN (0, 1)),  -- 1: no real chamber, no real boards
  time_scale           REAL NOT NULL CHECK (time_scale > 0 AND time_scale < 1e6 AND (time_scale = 1 OR simulated = 1)),  -- campaign seconds a wall second
  samples_per_setpoint INTEGER NOT NULL CHECK (samples_per_setpoint >= 1),  -- asked of each dwell
  sample_rate_hz       REAL NOT NULL CHECK (sample_rate_hz > 0 AND sample_rate_hz < 1e9),  -- asked of the boards
  monitor_interval_s   REAL NOT NULL CHECK (monitor_interval_s > 0 AND monitor_interval_s < 1e6),  -- spacing of the rows in monitor
  state                TEXT NOT NULL CHECK (state IN ('preflight', 'ramping', 'soaking', 'logging', 'returning', 'analysing', 'finished', 'paused', 'holding', 'safe', 'aborted'))  -- where it stands; over when finished or aborted
) STRICT;

CREATE TABLE board (  -- a gyro board in one campaign
  id                  INTEGER PRIMARY KEY,
  campaign_id         INTEGER NOT NULL REFERENCES campaign(id),  -- the campaign it took part in
  name                TEXT NOT NULL CHECK (name <> ''),  -- as in the campaign file
  device              TEXT NOT NULL,  -- the serial link it was reached by, or the session it came from
  mcu_id              TEXT NOT NULL,  -- unique id of its microcontroller, empty if unknown
  firmware_version    TEXT NOT NULL,  -- as the board answered
  hardware_version    TEXT NOT NULL,  -- as the board answered
  axes                TEXT NOT NULL CHECK (axes IN ('xyz', 'xy', 'xz', 'yz', 'x', 'y', 'z')),  -- those measured
  lsb_per_dps_x       REAL NOT NULL CHECK (lsb_per_dps_x > 0 AND lsb_per_dps_x < 1e9),  -- scale factor of X at 20 degC
  lsb_per_dps_y       REAL NOT NULL CHECK (lsb_per_dps_y > 0 AND lsb_per_dps_y < 1e9),  -- scale factor of Y at 20 degC
  lsb_per_dps_z       REAL NOT NULL CHECK (lsb_per_dps_z > 0 AND lsb_per_dps_z < 1e9),  -- scale factor of Z at 20 degC
  lsb_per_dps_per_k_x REAL NOT NULL CHECK (abs(lsb_per_dps_per_k_x) < 1e6),  -- its change per kelvin, X
  lsb_per_dps_per_k_y REAL NOT NULL CHECK (abs(lsb_per_dps_per_k_y) < 1e6),  -- its change per kelvin, Y
  lsb_per_dps_per_k_z REAL NOT NULL CHECK (abs(lsb_per_dps_per_k_z) < 1e6),  -- its change per kelvin, Z
  UNIQUE (campaign_id, name),
  UNIQUE (campaign_id, id)
) STRICT;

CREATE TABLE setpoint (  -- the plan: chamber temperatures in the order they are visited
  campaign_id INTEGER NOT NULL REFERENCES campaign(id),  -- whose plan
  ordinal     INTEGER NOT NULL CHECK (ordinal >= 0),  -- 0 is visited first
  setpoint_c  REAL NOT NULL CHECK (setpoint_c BETWEEN -273.15 AND 1000),  -- what the chamber is told
  PRIMARY KEY (campaign_id, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE dwell (  -- one board at one setpoint, one attempt
  id                     INTEGER PRIMARY KEY,
  campaign_id            INTEGER NOT NULL,  -- the campaign of board and setpoint
  board_id               INTEGER NOT NULL,  -- which board
  ordinal                INTEGER NOT NULL,  -- which setpoint
  attempt                INTEGER NOT NULL CHECK (attempt >= 1),  -- 1 is the first
  t_start_ns             INTEGER NOT NULL,  -- logging began
  t_end_ns               INTEGER NOT NULL CHECK (t_end_ns >= t_start_ns),  -- logging ended
  soak_s                 REAL CHECK (soak_s BETWEEN 0 AND 1e9),  -- in the band before logging
  timed_soak             INTEGER NOT NULL CHECK (timed_soak IN (0, 1)),  -- 1: by the clock, the board's sensor being too coarse for the asked slope
  chamber_mean_c         REAL CHECK (chamber_mean_c BETWEEN -273.15 AND 1000),  -- air while logging
  chamber_peak_to_peak_k REAL CHECK (chamber_peak_to_peak_k BETWEEN 0 AND 1000),  -- max - min of the air while logging
  board_mean_c           REAL CHECK (board_mean_c BETWEEN -273.15 AND 1000),  -- the board's own sensor while logging
  samples                INTEGER NOT NULL CHECK (samples >= 0),  -- its rows in sample
  frames_missing         INTEGER NOT NULL CHECK (frames_missing >= 0),  -- sent by the board, never received
  counter_first          INTEGER NOT NULL CHECK (counter_first >= 0),  -- frame counter of the sample with seq 0
  reject_reason          TEXT CHECK (reject_reason <> ''),  -- NULL: accepted
  UNIQUE (board_id, ordinal, attempt),
  FOREIGN KEY (campaign_id, board_id) REFERENCES board(campaign_id, id),
  FOREIGN KEY (campaign_id, ordinal) REFERENCES setpoint(campaign_id, ordinal)
) STRICT;

-- A setpoint's accepted dwell exists once for each board, whatever is started twice.
CREATE UNIQUE INDEX dwell_accepted ON dwell (board_id, ordinal) WHERE reject_reason IS NULL;
CREATE INDEX dwell_of_campaign ON dwell (campaign_id, ordinal);

CREATE TABLE sample (  -- raw counts as the board sent them; view sample_dps converts
  dwell_id        INTEGER NOT NULL REFERENCES dwell(id),  -- the dwell it was taken in
  seq             INTEGER NOT NULL CHECK (seq >= 0),  -- place in the board's stream, from 0; a hole is a lost sample
  t_ns            INTEGER NOT NULL,  -- when the board took it, by a fit of its counter to our clock
  gyro_x_lsb      INTEGER CHECK (gyro_x_lsb BETWEEN -32768 AND 32767),  -- X, roll; NULL: axis not measured
  gyro_y_lsb      INTEGER CHECK (gyro_y_lsb BETWEEN -32768 AND 32767),  -- Y, pitch
  gyro_z_lsb      INTEGER CHECK (gyro_z_lsb BETWEEN -32768 AND 32767),  -- Z, yaw
  temperature_raw INTEGER CHECK (temperature_raw BETWEEN -32768 AND 32767),  -- the board's sensor, degC * 256; NULL: not in the frame
  counter         INTEGER CHECK (counter >= 0),  -- frame counter where it is not counter_first + seq: the board restarted
  PRIMARY KEY (dwell_id, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE monitor (  -- the slow stream: means over an interval, the whole campaign, ramps included
  board_id        INTEGER NOT NULL REFERENCES board(id),  -- which board
  t_ns            INTEGER NOT NULL,  -- centre of the interval
  setpoint_c      REAL CHECK (setpoint_c BETWEEN -273.15 AND 1000),  -- what the chamber said it controls to
  chamber_c       REAL CHECK (chamber_c BETWEEN -273.15 AND 1000),  -- mean air temperature
  board_c         REAL CHECK (board_c BETWEEN -273.15 AND 1000),  -- mean of the board's own sensor
  gyro_x_mean_lsb REAL CHECK (abs(gyro_x_mean_lsb) <= 32768),  -- mean raw count, X
  gyro_y_mean_lsb REAL CHECK (abs(gyro_y_mean_lsb) <= 32768),  -- mean raw count, Y
  gyro_z_mean_lsb REAL CHECK (abs(gyro_z_mean_lsb) <= 32768),  -- mean raw count, Z
  frames          INTEGER NOT NULL CHECK (frames >= 0),  -- frames the means are over
  frames_missing  INTEGER NOT NULL CHECK (frames_missing >= 0),  -- sent by the board, never received
  PRIMARY KEY (board_id, t_ns)
) STRICT, WITHOUT ROWID;

CREATE TABLE event (  -- the journal: every transition, outage, refusal
  id          INTEGER PRIMARY KEY,
  campaign_id INTEGER NOT NULL REFERENCES campaign(id),  -- in which campaign
  t_ns        INTEGER NOT NULL,  -- campaign time
  utc_ns      INTEGER NOT NULL,  -- UTC as the machine had it, for the reader only
  severity    TEXT NOT NULL CHECK (severity IN ('info', 'warning', 'error')),  -- how bad
  kind        TEXT NOT NULL CHECK (kind <> ''),  -- one word a kind: transition, chamber_lost
  text        TEXT NOT NULL  -- a sentence
) STRICT;

CREATE INDEX event_of_campaign ON event (campaign_id, t_ns);
