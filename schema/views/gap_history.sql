CREATE VIEW gap_history AS  -- how the gap between simulation and measurement shrank, effect by effect
SELECT
  diagnosis.id AS diagnosis_id,  -- diagnosis.id
  diagnosis.source,  -- the session as a person names it
  diagnosis.axis,  -- gyro axis
  model_before.name AS rig_model_before,  -- what was compared
  model_after.name AS rig_model_after,  -- with all findings added
  finding.position AS step,  -- order of finding; NULL: nothing was missing
  finding.effect AS effect_added,  -- name in the catalogue, or unknown
  CASE WHEN finding.position IS NULL THEN diagnosis.gap_before ELSE finding.gap_before END AS gap_before,  -- error bars beyond chance, before the step
  CASE WHEN finding.position IS NULL THEN diagnosis.gap_after ELSE finding.gap_after END AS gap_after  -- after the step
FROM diagnosis
JOIN rig_model AS model_before ON model_before.id = diagnosis.rig_model_before_id
JOIN rig_model AS model_after ON model_after.id = diagnosis.rig_model_after_id
LEFT JOIN finding ON finding.diagnosis_id = diagnosis.id
ORDER BY diagnosis.id, finding.position;
