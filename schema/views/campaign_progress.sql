CREATE VIEW campaign_progress AS  -- where each campaign stands
SELECT
  campaign.id AS campaign_id,  -- campaign.id
  campaign.name AS campaign,  -- campaign's name
  campaign.state,  -- of the state machine
  datetime(nullif(campaign.utc_start_ns, 0) / 1000000000, 'unixepoch') AS utc_start,  -- when it began; NULL: unknown
  (SELECT count(*) FROM board WHERE board.campaign_id = campaign.id) AS boards,  -- taking part
  (SELECT count(*) FROM setpoint WHERE setpoint.campaign_id = campaign.id) AS setpoints,  -- planned
  (SELECT count(DISTINCT dwell.ordinal) FROM dwell WHERE dwell.campaign_id = campaign.id AND dwell.reject_reason IS NULL) AS setpoints_logged,  -- with an accepted dwell of any board
  (SELECT count(*) FROM dwell WHERE dwell.campaign_id = campaign.id AND dwell.reject_reason IS NULL) AS dwells_accepted,  -- one a board and setpoint
  (SELECT count(*) FROM dwell WHERE dwell.campaign_id = campaign.id AND dwell.reject_reason IS NOT NULL) AS dwells_rejected,  -- kept, with their reason
  (SELECT coalesce(sum(dwell.samples), 0) FROM dwell WHERE dwell.campaign_id = campaign.id) AS samples,  -- stored
  (SELECT coalesce(sum(dwell.frames_missing), 0) FROM dwell WHERE dwell.campaign_id = campaign.id) AS frames_missing,  -- lost while logging
  max((SELECT coalesce(max(event.t_ns), 0) FROM event WHERE event.campaign_id = campaign.id),
      (SELECT coalesce(max(dwell.t_end_ns), 0) FROM dwell WHERE dwell.campaign_id = campaign.id)) / 1e9 AS t_last_s  -- latest event or dwell, since campaign start
FROM campaign;
