-- The scale factor is taken at the board's temperature: of the sample, else of the dwell, else 20.
CREATE VIEW sample_dps AS  -- samples in degrees per second, with board, setpoint and time
SELECT
  dwell.campaign_id,  -- campaign.id
  board.name AS board,  -- board's name
  dwell.id AS dwell_id,  -- dwell.id
  setpoint.setpoint_c,  -- what the chamber was told
  dwell.reject_reason,  -- NULL: accepted
  sample.seq,  -- place in the dwell; a hole is a lost sample
  sample.t_ns / 1e9 AS t_s,  -- since campaign start
  sample.gyro_x_lsb / (board.lsb_per_dps_x + board.lsb_per_dps_per_k_x * (coalesce(sample.temperature_raw / 256.0, dwell.board_mean_c, 20.0) - 20.0)) AS gyro_x_dps,  -- X, roll
  sample.gyro_y_lsb / (board.lsb_per_dps_y + board.lsb_per_dps_per_k_y * (coalesce(sample.temperature_raw / 256.0, dwell.board_mean_c, 20.0) - 20.0)) AS gyro_y_dps,  -- Y, pitch
  sample.gyro_z_lsb / (board.lsb_per_dps_z + board.lsb_per_dps_per_k_z * (coalesce(sample.temperature_raw / 256.0, dwell.board_mean_c, 20.0) - 20.0)) AS gyro_z_dps,  -- Z, yaw
  sample.temperature_raw / 256.0 AS board_c  -- the board's own sensor
FROM sample
JOIN dwell ON dwell.id = sample.dwell_id
JOIN board ON board.id = dwell.board_id
JOIN setpoint ON setpoint.campaign_id = dwell.campaign_id AND setpoint.ordinal = dwell.ordinal;
