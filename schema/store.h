#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compensation/values/error.h"
#include "compensation/values/records.h"
#include "compensation/values/units.h"

namespace gyrocal {

/// All t_ns are campaign time: nanoseconds since the campaign's start; campaign.utc_start_ns stands
/// beside them.

struct CampaignRow {
  std::string name;
  std::string config_toml;  ///< the file as read
  std::string software_version;
  std::int64_t utc_start_ns = 0;  ///< 0: unknown, an imported session
  bool simulated = false;
  double time_scale = 1.0;
  int samples_per_setpoint = 0;
  double sample_rate_hz = 0;
  double monitor_interval_s = 5;  ///< spacing of the monitor rows
  std::string state;  ///< name of the state machine's state, kept current by set_campaign_state
};

struct BoardRow {
  std::string name;
  std::string device;
  std::string mcu_id;
  std::string firmware_version;
  std::string hardware_version;
  std::array<double, 3> lsb_per_dps{};
  std::array<double, 3> lsb_per_dps_per_k{};
  std::array<bool, 3> measured{true, true, true};  ///< axes with data; an imported session has one
};

struct SetpointRow {
  int ordinal = 0;  ///< 0-based, order of visit
  Celsius setpoint{0};
};

/// One board at one setpoint, one attempt.
struct DwellRow {
  BoardId board{};
  int ordinal = 0;  ///< of the setpoint
  int attempt = 1;  ///< 1-based
  std::int64_t t_start_ns = 0;
  std::int64_t t_end_ns = 0;
  double soak_s = 0;        ///< missing: unknown
  bool timed_soak = false;  ///< the sensor was too coarse for the asked slope
  double chamber_mean_c = missing;
  double chamber_peak_to_peak_k = missing;
  double board_mean_c = missing;
  std::int64_t frames_missing = 0;
  std::optional<std::string> reject_reason;  ///< absent: accepted
};

struct DwellWithSamples {
  DwellRow dwell;
  std::span<const BoardSample> samples;  ///< raw counts, one row each
};

struct MonitorInsert {
  BoardId board{};
  std::int64_t t_ns = 0;  ///< centre of the interval
  double setpoint_c = missing;
  double chamber_c = missing;
  double board_c = missing;
  std::array<double, 3> gyro_mean_lsb{missing, missing, missing};
  std::int64_t frames = 0;
  std::int64_t frames_missing = 0;
};

struct EventInsert {
  std::int64_t t_ns = 0;
  std::int64_t utc_ns = 0;
  std::string severity;  ///< "info" "warning" "error"
  std::string kind;      ///< "transition" "chamber_lost" ... one word a kind
  std::string text;      ///< a sentence
};

/// What the filter made of one accepted dwell and axis.
struct DwellDriftInsert {
  DwellId dwell{};
  Axis axis = Axis::z;
  double raw_mean_dps = 0;
  double raw_sd_dps = 0;
  double filtered_mean_dps = 0;
  double filtered_sd_dps = 0;
  double standard_error_dps = missing;  ///< from the dwell's own autocorrelated noise
};

/// What an analysis was made with; the same settings, dwells and version give the same results to
/// the last bit.
struct AnalysisSettings {
  std::string settings_json;  ///< wavelet, level, mode, rule
  std::string software_version;
};

struct ModelPoint {
  double temperature_c = 0;
  double measured_dps = 0;
  double fitted_dps = 0;
  double band_dps = missing;  ///< half width of the 95 % prediction band
};

struct ModelInsert {
  BoardId board{};
  Axis axis = Axis::z;
  std::string method;
  std::string parameters_json;  ///< all that is needed to evaluate the model
  double rmse_dps = 0;          ///< divided by n
  double rmse_n_minus_1_dps = 0;
  double mae_dps = 0;
  double max_dps = 0;
  double loocv_rmse_dps = missing;
  double block_rmse_dps = missing;        ///< each setpoint and its neighbours held out
  double effective_parameters = missing;  ///< trace of d fitted / d measured
  bool recommended = false;
  std::string reason;           ///< why recommended, or empty
  std::string warnings;         ///< sentences, one a line
  std::string dwells_sha256;    ///< over the raw samples of the dwells used
  std::vector<DwellId> dwells;  ///< those used
  std::vector<ModelPoint> points;
};

/// An accepted dwell as the analysis needs it.
struct AcceptedDwell {
  DwellId id{};
  int ordinal = 0;
  Celsius setpoint{0};
  double chamber_mean_c = missing;
  double board_mean_c = missing;
};

/// A campaign that has not ended, as --resume needs it.
struct OpenCampaign {
  CampaignId id{};
  CampaignRow campaign;
  std::int64_t t_last_ns = 0;  ///< the latest time stored
  std::vector<std::pair<BoardId, BoardRow>> boards;
  std::vector<DwellRow> dwells;  ///< all, rejected ones included, in order
};

struct RigEffectRow {
  std::string effect;           ///< name in the catalogue
  std::string law;              ///< empty if the effect has one
  std::string parameters_json;  ///< name to value, units as in the catalogue
};

/// What a simulation contains.
struct RigModelRow {
  std::string name;
  std::string sha256;                ///< of model_json
  std::optional<RigModelId> parent;  ///< what it was made from
  std::string baseline_json;
  std::string model_json;  ///< the whole model as its file holds it
  std::string software_version;
  std::vector<RigEffectRow> effects;
};

/// One effect a diagnosis named; gaps are those of the step that added it.
struct FindingRow {
  std::string effect;  ///< name in the catalogue, or "unknown"
  double amplitude = 0;
  std::string unit;
  double standard_error = missing;
  std::string parameters_json;
  double evidence_nats = missing;
  double lead_nats = missing;
  std::string confounded_with_json;
  std::string tell_apart;
  std::string description;
  double gap_before = missing;
  double gap_after = missing;
};

struct DiagnosisInsert {
  std::optional<BoardId> board;  ///< absent: a session directory
  Axis axis = Axis::z;
  std::string source;  ///< the session as a person names it
  RigModelId model_before{};
  RigModelId model_after{};
  std::string verdict;  ///< "consistent" "explained" "unexplained" "confounded"
  double gap_before = 0;
  double gap_after = 0;
  std::string report_json;  ///< gyrocal-diagnosis/1, whole
  std::string software_version;
  std::vector<FindingRow> findings;  ///< in the order of finding
};

/// The typed way into the database (DESIGN section 8), used by one thread. One writer; every
/// function that writes is one transaction and has stored all of it, on disk, when it returns
/// without error, or nothing. Errors: storage (the message names file and reason), busy (somebody
/// else writes), mismatch (a newer schema, another application), bad_input (a row the tables
/// refuse).
class Store {
 public:
  /// Opens or creates and migrates to the present schema. Takes the writer's lock; a second writer
  /// gets busy, with the holder's process id.
  [[nodiscard]] static Result<Store> open(const std::string& path);
  /// Opens what exists, for reading only; also while a campaign writes, and on a disk nobody can
  /// write to.
  [[nodiscard]] static Result<Store> open_read_only(const std::string& path);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  // The campaign writes.
  [[nodiscard]] Result<CampaignId> begin_campaign(const CampaignRow& campaign,
                                                  std::span<const SetpointRow> setpoints);
  [[nodiscard]] Result<BoardId> add_board(CampaignId campaign, const BoardRow& board);
  [[nodiscard]] Result<void> set_campaign_state(CampaignId campaign, const std::string& state);
  [[nodiscard]] Result<void> add_monitor(CampaignId campaign, std::span<const MonitorInsert> rows);
  [[nodiscard]] Result<void> add_event(CampaignId campaign, const EventInsert& event);
  /// One group: the dwells of all boards at one setpoint, with their samples.
  [[nodiscard]] Result<std::vector<DwellId>> add_group(CampaignId campaign,
                                                       std::span<const DwellWithSamples> dwells);
  /// Drifts and models of one pass over the accepted dwells. A former pass with the same settings
  /// is replaced, one with others stays; the views show the latest.
  [[nodiscard]] Result<void> add_analysis(CampaignId campaign, const AnalysisSettings& settings,
                                          std::span<const DwellDriftInsert> drifts,
                                          std::span<const ModelInsert> models);

  /// A model already there, by its sha256, is not stored again.
  [[nodiscard]] Result<RigModelId> add_rig_model(const RigModelRow& model);
  [[nodiscard]] Result<void> add_diagnosis(const DiagnosisInsert& diagnosis);

  // What is read back.
  /// All that `body` reads is of one moment, whatever is stored meanwhile; it writes nothing.
  [[nodiscard]] Result<void> snapshot(const std::function<Result<void>()>& body) const;
  [[nodiscard]] Result<std::optional<OpenCampaign>> open_campaign() const;  ///< the latest, unended
  [[nodiscard]] Result<std::optional<CampaignId>> latest_campaign() const;
  [[nodiscard]] Result<CampaignRow> campaign(CampaignId campaign) const;
  [[nodiscard]] Result<std::vector<std::pair<BoardId, BoardRow>>> boards(CampaignId campaign) const;
  [[nodiscard]] Result<std::vector<AcceptedDwell>> accepted_dwells(CampaignId campaign,
                                                                   BoardId board) const;
  /// Every attempt, rejected ones included, in the order they were logged.
  [[nodiscard]] Result<std::vector<DwellRow>> dwells(CampaignId campaign) const;
  [[nodiscard]] Result<std::vector<EventInsert>> events(CampaignId campaign) const;  ///< as told
  /// One board's slow stream before t, in order of time.
  [[nodiscard]] Result<std::vector<MonitorInsert>> monitor_before(BoardId board,
                                                                  std::int64_t t_ns) const;
  /// Raw samples of a dwell, in order of seq.
  [[nodiscard]] Result<std::vector<BoardSample>> samples(DwellId dwell) const;
  /// Zero drifts by the campaign's latest analysis, in the order of the setpoints; none if it has
  /// not been analysed.
  [[nodiscard]] Result<std::vector<DwellDriftInsert>> drifts(CampaignId campaign, BoardId board,
                                                             Axis axis) const;
  /// Models of the campaign's latest analysis.
  [[nodiscard]] Result<std::vector<ModelInsert>> models(CampaignId campaign, BoardId board,
                                                        Axis axis) const;
  /// The settings of the campaign's latest analysis.
  [[nodiscard]] Result<std::optional<AnalysisSettings>> analysis_settings(
      CampaignId campaign) const;
  /// Every rig model, parents before children.
  [[nodiscard]] Result<std::vector<std::pair<RigModelId, RigModelRow>>> rig_models() const;
  /// One axis of one board as the diagnosis reads it: monitor and accepted dwells in deg/s by the
  /// board's scale factor at its temperature; a dwell's number is its setpoint's ordinal.
  [[nodiscard]] Result<Session> session(CampaignId campaign, BoardId board, Axis axis) const;

 private:
  struct Impl;
  explicit Store(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrocal
