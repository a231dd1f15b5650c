#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "compensation/drift/allan.h"
#include "compensation/drift/allan_noise.h"
#include "compensation/drift/allan_pieces.h"
#include "daemon/cli/command.h"
#include "daemon/cli/csv_columns.h"
#include "daemon/cli/number_list.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/stored_drift.h"
#include "schema/session/session_csv.h"
#include "schema/store.h"

namespace gyrocal::cli {
namespace {

struct AllanOptions {
  double rate_hz = 50;
  std::string table;
  std::string column = "gyro_z_dps";
  std::string session;
  std::string database;
  std::string board;
  std::string axis = "z";
  std::optional<int> dwell;
  bool as_json = false;
};

struct Rate {
  std::vector<std::vector<double>> pieces;
  double sample_rate_hz;
};

struct Answer {
  std::size_t pieces;
  std::size_t samples;
  std::vector<AllanPoint> points;
  AllanNoise noise;
};

/// @param source  for messages: the folder or the database.
Result<Rate> rate_of_dwells(const Session& session, const std::string& source,
                            std::optional<int> dwell) {
  Rate rate{unbroken_pieces(session.samples, dwell), session.sample_rate_hz};
  if (!rate.pieces.empty()) return rate;
  std::string known;
  for (const SessionDwell& one : session.dwells) known += fmt::format(" {}", one.dwell);
  return fail(Errc::too_few_points,
              dwell ? fmt::format("{} has no gyro sample in dwell {}", source, *dwell)
                    : fmt::format("{} has no gyro sample in any dwell", source),
              "its dwells:" + known);
}

Result<Rate> rate_of_session(const AllanOptions& options) {
  const auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  return rate_of_dwells(*session, options.session, options.dwell);
}

Result<Rate> rate_of_database(const AllanOptions& options) {
  const auto store = Store::open_read_only(options.database);
  if (!store) return tl::unexpected(store.error());
  const auto sensors = sensors_of(*store, options.board, options.axis);
  if (!sensors) return tl::unexpected(sensors.error());
  if (sensors->size() != 1) {
    std::string names;
    for (const StoredSensor& sensor : *sensors) names += ' ' + sensor.board.name;
    return fail(Errc::bad_input,
                fmt::format("{} has {} boards with that axis", options.database, sensors->size()),
                "choose one with --board:" + names);
  }
  const StoredSensor& sensor = sensors->front();
  const auto session = store->session(sensor.campaign, sensor.id, sensor.axis);
  if (!session) return tl::unexpected(session.error());
  return rate_of_dwells(*session, options.database, options.dwell);
}

Result<Rate> rate_of_table(const AllanOptions& options) {
  const auto text = read_text(options.table);
  if (!text) return tl::unexpected(text.error());
  const auto csv = parse_csv(*text, options.table == "-" ? "standard input" : options.table);
  if (!csv) return tl::unexpected(csv.error());
  const auto column = column_named(*csv, options.column);
  if (!column) return tl::unexpected(column.error());
  auto numbers = numbers_of(*csv, *column);
  if (!numbers) return tl::unexpected(numbers.error());
  return Rate{{std::move(*numbers)}, options.rate_hz};
}

Result<Rate> rate_of_standard_input(const AllanOptions& options) {
  const auto text = read_text("-");
  if (!text) return tl::unexpected(text.error());
  auto numbers = parse_numbers(*text, "standard input");
  if (!numbers) return tl::unexpected(numbers.error());
  return Rate{{std::move(*numbers)}, options.rate_hz};
}

Result<Rate> rate_of(const AllanOptions& options) {
  if (!options.session.empty()) return rate_of_session(options);
  if (!options.database.empty()) return rate_of_database(options);
  if (!options.table.empty()) return rate_of_table(options);
  return rate_of_standard_input(options);
}

Result<Answer> answer_to(const Rate& rate) {
  constexpr int per_decade = 8;
  const std::vector<std::span<const double>> pieces(rate.pieces.begin(), rate.pieces.end());
  const auto noise = fit_allan_noise(pieces, rate.sample_rate_hz);
  if (!noise) return tl::unexpected(noise.error());
  auto points =
      overlapping_allan(pieces, rate.sample_rate_hz, allan_factors(longest_of(pieces), per_decade));
  if (!points) return tl::unexpected(points.error());
  std::size_t samples = 0;
  for (const auto piece : pieces) samples += piece.size();
  return Answer{pieces.size(), samples, std::move(*points), *noise};
}

nlohmann::ordered_json json_of(const NoiseCoefficient& one, const char* unit) {
  return {{"value", one.value},
          {"low", one.low},
          {"high", one.high},
          {"resolved", one.resolved},
          {"unit", unit}};
}

void print_json(const Answer& answer) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const AllanPoint& point : answer.points) {
    points.push_back({{"tau_s", point.tau_s},
                      {"averaged", point.averaged},
                      {"deviation_dps", point.deviation},
                      {"low_dps", point.deviation_low},
                      {"high_dps", point.deviation_high},
                      {"degrees_of_freedom", point.degrees_of_freedom}});
  }
  const AllanNoise& noise = answer.noise;
  const nlohmann::ordered_json json{
      {"sample_rate_hz", noise.sample_rate_hz},
      {"samples", answer.samples},
      {"pieces", answer.pieces},
      {"confidence", 0.95},
      {"points", std::move(points)},
      {"angle_random_walk", json_of(noise.angle_random_walk, "deg/s/sqrt(Hz)")},
      {"bias_instability", json_of(noise.bias_instability, "deg/s")},
      {"rate_random_walk", json_of(noise.rate_random_walk, "deg/s/sqrt(s)")},
      {"correlated", json_of(noise.correlated, "deg/s")},
      {"correlation_time_s", noise.correlation_time_s},
      {"fitted_from_s", static_cast<double>(noise.fitted_from) / noise.sample_rate_hz},
      {"described", noise.described}};
  fmt::print("{}\n", json.dump());
}

/// One coefficient a line, in deg/s and in the unit that data sheets use.
void print_coefficient(const char* name, const NoiseCoefficient& one, const char* unit,
                       double per_hour_factor, const char* unit_per_hour) {
  if (!one.resolved) {
    fmt::print("{:<20}below {:.4g} {} = {:.4g} {} (95 %; not seen in these data)\n", name, one.high,
               unit, one.high * per_hour_factor, unit_per_hour);
    return;
  }
  fmt::print("{:<20}{:.4g} ({:.4g} to {:.4g}) {} = {:.4g} {}\n", name, one.value, one.low, one.high,
             unit, one.value * per_hour_factor, unit_per_hour);
}

void print_table(const Answer& answer) {
  fmt::print("{:>10}{:>9}{:>14}{:>28}\n", "tau s", "samples", "deviation", "95 % interval, deg/s");
  for (const AllanPoint& point : answer.points) {
    fmt::print("{:>10.4g}{:>9}{:>14.5g}{:>14.5g}{:>14.5g}\n", point.tau_s, point.averaged,
               point.deviation, point.deviation_low, point.deviation_high);
  }
  const AllanNoise& noise = answer.noise;
  print_coefficient("angle random walk", noise.angle_random_walk, "deg/s/sqrt(Hz)", 60,
                    "deg/sqrt(h)");
  print_coefficient("bias instability", noise.bias_instability, "deg/s", 3600, "deg/h");
  print_coefficient("rate random walk", noise.rate_random_walk, "deg/s/sqrt(s)", 3600 * 60,
                    "deg/h/sqrt(h)");
  if (noise.correlated.resolved) {
    fmt::print("{:<20}{:.4g} ({:.4g} to {:.4g}) deg/s with a memory of {:.4g} s\n",
               "correlated noise", noise.correlated.value, noise.correlated.low,
               noise.correlated.high, noise.correlation_time_s);
  }
  if (noise.fitted_from > 1) {
    fmt::print("fitted from {:.4g} s on: faster noise is of another kind (filtered, quantised)\n",
               static_cast<double>(noise.fitted_from) / noise.sample_rate_hz);
  }
}

int allan(const AllanOptions& options) {
  const auto rate = rate_of(options);
  if (!rate) return report(rate.error());
  const auto answer = answer_to(*rate);
  if (!answer) return report(answer.error());
  if (!answer->noise.described) {
    fmt::print(
        stderr,
        "warning: no sum of white, flicker, random-walk and correlated noise describes these "
        "data; is there a trend or a jump in them?\n");
  }
  if (options.as_json) {
    print_json(*answer);
  } else {
    print_table(*answer);
  }
  return exit_done;
}

}  // namespace

void add_allan(Command& root, Chosen& chosen) {
  const auto options = std::make_shared<AllanOptions>();
  auto* command = root.add_subcommand(
      "allan",
      "Example: gyrocal allan --rate-hz 50 < dwell.txt\n"
      "         gyrocal allan --table long_run.csv --column gyro_z_dps --rate-hz 50\n"
      "         gyrocal allan --session monday --dwell 3\n"
      "         gyrocal allan --db demo.db --board board0 --axis z\n"
      "Overlapping Allan deviation of a rate in deg/s, with angle random walk and bias "
      "instability.");
  auto* rate =
      command->add_option("--rate-hz", options->rate_hz, "samples a second")->capture_default_str();
  auto* table =
      command->add_option("--table", options->table, "a CSV file instead; - for standard input");
  command->add_option("--column", options->column, "its column")
      ->capture_default_str()
      ->needs(table);
  auto* session = command->add_option("--session", options->session, "a session directory instead")
                      ->excludes(table)
                      ->excludes(rate);
  auto* database = command
                       ->add_option("--db", options->database,
                                    "a campaign's database instead: the latest campaign in it")
                       ->excludes(table)
                       ->excludes(session)
                       ->excludes(rate);
  command->add_option("--board", options->board, "its board; the only one if left out")
      ->needs(database);
  command->add_option("--axis", options->axis, "x, y or z")->capture_default_str()->needs(database);
  command->add_option("--dwell", options->dwell,
                      "one dwell of the session or database; all if left out");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return allan(*options); }; });
}

}  // namespace gyrocal::cli
