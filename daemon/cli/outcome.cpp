#include "daemon/cli/outcome.h"

#include <cstdio>

namespace gyrocal::cli {
namespace {

int exit_code(Errc code) {
  switch (code) {
    case Errc::out_of_range:
    case Errc::not_finite:
    case Errc::too_few_points:
    case Errc::bad_input:
    case Errc::unknown_name:
      return exit_bad_input;
    case Errc::timeout:
    case Errc::link_lost:
    case Errc::refused:
    case Errc::bad_frame:
    case Errc::mismatch:
    case Errc::busy:
    case Errc::storage:
      return exit_failed;
  }
  return exit_failed;
}

}  // namespace

int report(const Error& error) {
  std::fprintf(stderr, "gyrocal: %s\n", error.what.c_str());
  if (!error.advice.empty()) std::fprintf(stderr, "  advice: %s\n", error.advice.c_str());
  return exit_code(error.code);
}

}  // namespace gyrocal::cli
