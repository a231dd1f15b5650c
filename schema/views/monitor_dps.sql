CREATE VIEW monitor_dps AS  -- the slow stream in degrees per second
SELECT
  board.campaign_id,  -- campaign.id
  board.name AS board,  -- board's name
  monitor.t_ns / 1e9 AS t_s,  -- centre of the interval, since campaign start
  monitor.setpoint_c,  -- what the chamber said it controls to
  monitor.chamber_c,  -- mean air temperature
  monitor.board_c,  -- mean of the board's own sensor
  monitor.gyro_x_mean_lsb / (board.lsb_per_dps_x + board.lsb_per_dps_per_k_x * (coalesce(monitor.board_c, 20.0) - 20.0)) AS gyro_x_dps,  -- mean rate, X
  monitor.gyro_y_mean_lsb / (board.lsb_per_dps_y + board.lsb_per_dps_per_k_y * (coalesce(monitor.board_c, 20.0) - 20.0)) AS gyro_y_dps,  -- mean rate, Y
  monitor.gyro_z_mean_lsb / (board.lsb_per_dps_z + board.lsb_per_dps_per_k_z * (coalesce(monitor.board_c, 20.0) - 20.0)) AS gyro_z_dps,  -- mean rate, Z
  monitor.frames,  -- frames the means are over
  monitor.frames_missing  -- sent by the board, never received
FROM monitor
JOIN board ON board.id = monitor.board_id;
