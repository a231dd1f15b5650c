#include <fmt/core.h>

#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "compensation/rig/simulate_session.h"
#include "config/rig_model.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/rig_command.h"
#include "schema/session/session_csv.h"

namespace gyrocal::cli {
namespace {

struct SimulateOptions {
  std::string out;
  std::string model = default_rig_model;
  std::uint64_t seed = 1;
  rig::SessionPlan plan;
  rig::SessionSubject subject;
  std::optional<double> noise_dps;
  std::optional<double> lsb_dps;
  std::optional<double> heating_c_per_min;
  std::optional<double> cooling_c_per_min;
  bool as_json = false;
};

Result<void> set_positive(const char* option, const std::optional<double>& value, double low,
                          double high, double& into) {
  if (!value) return {};
  if (!std::isfinite(*value) || *value < low || *value > high) {
    return fail(Errc::out_of_range, fmt::format("{} {}: out of range", option, *value),
                fmt::format("allowed: {}..{}", low, high));
  }
  into = *value;
  return {};
}

/// What the command line says about the rig stands above its file.
Result<void> override_model(const SimulateOptions& options, rig::RigModel& model) {
  rig::Baseline& base = model.baseline;
  double lsb_dps = 1.0 / base.lsb_per_dps;
  for (const auto& ok : {set_positive("--noise", options.noise_dps, 0.0, 1000.0, base.noise_dps),
                         set_positive("--lsb", options.lsb_dps, 1e-4, 100.0, lsb_dps),
                         set_positive("--heating", options.heating_c_per_min, 0.01, 100.0,
                                      base.chamber.heating_c_per_min),
                         set_positive("--cooling", options.cooling_c_per_min, 0.01, 100.0,
                                      base.chamber.cooling_c_per_min)}) {
    if (!ok) return ok;
  }
  if (options.lsb_dps) base.lsb_per_dps = 1.0 / lsb_dps;
  return {};
}

void print_summary(const SimulateOptions& options, const Session& session) {
  const double hours = session.monitor.empty()
                           ? 0.0
                           : (session.monitor.back().t_s + session.monitor.front().t_s) / 3600.0;
  if (options.as_json) {
    fmt::print("{}\n", nlohmann::json{{"out", options.out},
                                      {"seed", options.seed},
                                      {"hours", hours},
                                      {"dwells", session.dwells.size()},
                                      {"samples", session.samples.size()},
                                      {"monitor_rows", session.monitor.size()}}
                           .dump());
  } else {
    fmt::print("{}: {:.1f} h, {} dwells, {} samples, {} monitor rows\n", options.out, hours,
               session.dwells.size(), session.samples.size(), session.monitor.size());
  }
}

int simulate(const SimulateOptions& options) {
  auto model = read_rig_model(options.model);
  if (!model) return report(model.error());
  if (const auto ok = override_model(options, *model); !ok) return report(ok.error());
  if (const auto ok = check(options.plan); !ok) return report(ok.error());
  const Session session =
      rig::simulate_session(*model, options.plan, options.seed, options.subject);
  if (const auto ok = write_session(options.out, session); !ok) return report(ok.error());
  print_summary(options, session);
  return exit_done;
}

void add_plan_options(Command& command, SimulateOptions& options) {
  static const std::map<std::string, rig::Sweep> sweeps{
      {"up", rig::Sweep::up}, {"up_down", rig::Sweep::up_down}, {"shuffled", rig::Sweep::shuffled}};
  rig::SessionPlan& plan = options.plan;
  command.add_named("--plan", plan.sweep, sweeps, "order of the setpoints: up, up_down, shuffled");
  command
      .add_option("--setpoints", plan.setpoints_c, "degC, as -10,0,10 (default: the paper's 25)")
      ->delimiter(',');
  command.add_option("--revisit", plan.revisits_c, "setpoints to visit again at the end")
      ->delimiter(',');
  command.add_option("--soak", plan.soak_s, "s in the air band before a dwell [1200]");
  command.add_option("--samples", plan.samples_per_dwell, "samples a dwell [3000]");
  command.add_option("--rate", plan.sample_rate_hz, "samples a second [50]");
  command.add_option("--monitor-interval", plan.monitor_interval_s, "s a monitor row [5]");
  command.add_option("--power-cycle-before", plan.power_cycle_before,
                     "power the board off and on before this visit, counted from 0");
}

void add_rig_options(Command& command, SimulateOptions& options) {
  static const std::map<std::string, Axis> axes{{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};
  command.add_option("--rig-model", options.model, "name or file [default]");
  command.add_option("--seed", options.seed, "of noise and of a shuffled plan [1]");
  command.add_named("--axis", options.subject.axis, axes, "x, y or z [z]");
  command.add_option("--board", options.subject.board, "index of the board in the chamber [0]");
  command.add_option("--noise", options.noise_dps, "deg/s a sample, instead of the model's");
  command.add_option("--lsb", options.lsb_dps, "deg/s a count, instead of the model's");
  command.add_option("--heating", options.heating_c_per_min, "degC/min, instead of the model's");
  command.add_option("--cooling", options.cooling_c_per_min, "degC/min, instead of the model's");
}

}  // namespace

void add_rig_simulate(Command& rig, Chosen& chosen) {
  auto* command = rig.add_subcommand(
      "simulate",
      "Example: gyrocal rig simulate --out session --rig-model quiet_hysteresis --plan up_down\n"
      "Writes a session directory (session-csv/1) of a whole campaign in virtual time.");
  const auto options = std::make_shared<SimulateOptions>();
  command->add_option("--out", options->out, "directory, made if it is not there")->required();
  add_plan_options(*command, *options);
  add_rig_options(*command, *options);
  command->add_flag("--json", options->as_json, "print the summary as JSON");
  command->callback([options, &chosen] { chosen = [options] { return simulate(*options); }; });
}

}  // namespace gyrocal::cli
