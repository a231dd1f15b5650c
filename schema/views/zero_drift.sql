CREATE VIEW zero_drift AS  -- zero drift per board, axis and setpoint, by the campaign's latest analysis
SELECT
  campaign.id AS campaign_id,  -- campaign.id
  campaign.name AS campaign,  -- campaign's name
  board.name AS board,  -- board's name
  dwell_drift.axis,  -- gyro axis
  setpoint.ordinal,  -- order of visit
  setpoint.setpoint_c,  -- what the chamber was told
  dwell.chamber_mean_c,  -- air while logging
  dwell.board_mean_c,  -- the board's own sensor while logging
  dwell_drift.raw_mean_dps,  -- mean of the samples
  dwell_drift.raw_sd_dps,  -- their standard deviation
  dwell_drift.filtered_mean_dps,  -- mean after the filter: the zero drift
  dwell_drift.filtered_sd_dps,  -- standard deviation after the filter
  dwell_drift.standard_error_dps  -- of the zero drift
FROM campaign
JOIN dwell_drift ON dwell_drift.analysis_id = (SELECT max(analysis.id) FROM analysis WHERE analysis.campaign_id = campaign.id)
JOIN dwell ON dwell.id = dwell_drift.dwell_id
JOIN board ON board.id = dwell.board_id
JOIN setpoint ON setpoint.campaign_id = dwell.campaign_id AND setpoint.ordinal = dwell.ordinal;
