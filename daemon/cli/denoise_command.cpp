#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "compensation/wavelet/denoise.h"
#include "daemon/cli/command.h"
#include "daemon/cli/csv_columns.h"
#include "daemon/cli/number_list.h"
#include "daemon/cli/one_of.h"
#include "daemon/cli/outcome.h"

namespace gyrocal::cli {
namespace {

struct DenoiseOptions {
  std::string wavelet = "db4";
  std::string mode = "symmetric";
  int level = 5;
  std::string rule = "approximation";
  std::string noise = "global";
  bool as_json = false;
};

Result<DenoiseSettings> settings_of(const DenoiseOptions& options) {
  const auto bank = find_filter_bank(options.wavelet);
  if (!bank) return tl::unexpected(bank.error());
  const auto boundary = find_boundary(options.mode);
  if (!boundary) return tl::unexpected(boundary.error());
  const auto rule = find_denoise_rule(options.rule);
  if (!rule) return tl::unexpected(rule.error());
  if (options.noise != "global" && options.noise != "per-level") {
    return fail(Errc::unknown_name, fmt::format("unknown noise estimate '{}'", options.noise),
                one_of(options.noise, "estimates", {"global", "per-level"}));
  }
  return DenoiseSettings{
      .wavelet = {*bank, *boundary, options.level},
      .rule = *rule,
      .noise = options.noise == "global" ? NoiseEstimate::global : NoiseEstimate::per_level};
}

void print_json(const Denoised& result, NoiseEstimate noise) {
  nlohmann::ordered_json bands = nlohmann::ordered_json::array();
  for (std::size_t band = 0; band < result.coefficients.bands(); ++band) {
    bands.push_back(result.coefficients.band(band));
  }
  nlohmann::ordered_json json{{"coefficients", std::move(bands)}, {"sigma", result.sigma}};
  if (noise == NoiseEstimate::per_level) json["sigma_by_level"] = result.sigma_by_level;
  json["thresholds"] = result.thresholds;
  json["denoised"] = result.denoised;
  fmt::print("{}\n", json.dump());
}

void print_numbers(const std::vector<double>& numbers) {
  std::string lines;
  for (const double number : numbers) fmt::format_to(std::back_inserter(lines), "{}\n", number);
  fmt::print("{}", lines);
}

void warn_if_deep(const Wavelet& wavelet, std::size_t samples) {
  const int useful = useful_level(samples, wavelet.bank->taps());
  if (wavelet.level <= useful) return;
  fmt::print(stderr,
             "warning: at level {} every coefficient of {} has seen an end of the {} samples "
             "(useful up to level {})\n",
             wavelet.level, wavelet.bank->name, samples, useful);
}

int denoise_standard_input(const DenoiseOptions& options) {
  const auto settings = settings_of(options);
  if (!settings) return report(settings.error());
  const auto text = read_text("-");
  if (!text) return report(text.error());
  const auto signal = parse_numbers(*text, "standard input");
  if (!signal) return report(signal.error());
  const auto result = denoise(*signal, *settings);
  if (!result) return report(result.error());
  warn_if_deep(settings->wavelet, signal->size());
  if (options.as_json) {
    print_json(*result, settings->noise);
  } else {
    print_numbers(result->denoised);
  }
  return exit_done;
}

}  // namespace

void add_denoise(Command& root, Chosen& chosen) {
  const auto options = std::make_shared<DenoiseOptions>();
  auto* command = root.add_subcommand(
      "denoise",
      "Example: gyrocal denoise --wavelet db4 --level 5 --rule soft-universal < dwell.txt\n"
      "Filters numbers from standard input; the defaults are the paper's filter.");
  command->add_option("--wavelet", options->wavelet, "haar, db2..db10, sym2..sym8, coif1..coif5")
      ->capture_default_str();
  command
      ->add_option("--mode", options->mode,
                   "beyond the ends: symmetric, periodization, zero, constant, reflect, periodic")
      ->capture_default_str();
  command->add_option("--level", options->level, "how many times to halve the rate")
      ->capture_default_str();
  command
      ->add_option("--rule", options->rule,
                   "approximation, or soft|hard|garrote-universal|sure|minimax|bayes")
      ->capture_default_str();
  command
      ->add_option("--noise", options->noise,
                   "deviation of the noise from the finest details (global) or each level's own "
                   "(per-level)")
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "coefficients, sigma, thresholds and denoised");
  command->callback(
      [options, &chosen] { chosen = [options] { return denoise_standard_input(*options); }; });
}

}  // namespace gyrocal::cli
