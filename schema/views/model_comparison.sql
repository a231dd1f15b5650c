CREATE VIEW model_comparison AS  -- the paper's Table 2 for every board and axis, by the latest analysis
SELECT
  campaign.id AS campaign_id,  -- campaign.id
  campaign.name AS campaign,  -- campaign's name
  board.name AS board,  -- board's name
  model.axis,  -- gyro axis
  model.method,  -- gm11, improved_gm11, least_squares, ...
  model.rmse_dps,  -- fitted against measured, divided by n
  model.mae_dps,  -- mean absolute error
  model.loocv_rmse_dps,  -- leave-one-out: the honest one
  model.rmse_n_minus_1_dps,  -- divided by n - 1, as parts of the paper do
  model.max_dps,  -- largest absolute error
  model.recommended,  -- 1: the one to use
  model.block_rmse_dps,  -- each setpoint predicted without it and its neighbours
  model.warnings  -- sentences, one a line
FROM campaign
JOIN model ON model.analysis_id = (SELECT max(analysis.id) FROM analysis WHERE analysis.campaign_id = campaign.id)
JOIN board ON board.id = model.board_id;
