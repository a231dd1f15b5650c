#include "daemon/replay/capsule.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "daemon/replay/capsule_contents.h"
#include "daemon/replay/recorded_span.h"
#include "daemon/replay/scratch_folder.h"
#include "daemon/runner/progress.h"
#include "daemon/runner/run_recording.h"
#include "schema/campaign_slice.h"

namespace gyrocal::replay {
namespace {

using runner::clock_text;

Result<CampaignId> chosen_campaign(const CapsuleRequest& request) {
  if (request.campaign) return CampaignId{*request.campaign};
  const auto store = Store::open_read_only(request.database);
  if (!store) return tl::unexpected(store.error());
  const auto latest = store->latest_campaign();
  if (!latest) return tl::unexpected(latest.error());
  if (*latest) return **latest;
  return fail(Errc::bad_input, request.database + ": no campaign");
}

/// The runs of the campaign that the window touches.
Result<std::vector<RecordedSpan>> spans_in_window(const std::string& recording, CampaignId campaign,
                                                  const CapsuleRequest& request) {
  auto spans = recorded_spans(recording);
  if (!spans) return spans;
  std::erase_if(*spans, [&](const RecordedSpan& span) { return span.campaign != campaign; });
  std::string known;
  for (const auto& span : *spans) {
    known += fmt::format(" {} to {}", clock_text(span.from), clock_text(span.to));
  }
  std::erase_if(*spans, [&](const RecordedSpan& span) {
    return span.to < request.from || span.from > request.to;
  });
  if (!spans->empty()) return spans;
  return fail(Errc::bad_input,
              fmt::format("{}: nothing of campaign {} was recorded in that window", recording,
                          static_cast<std::int64_t>(campaign)),
              known.empty() ? "was it run with --no-record?" : "what was recorded:" + known);
}

Result<void> copy_run(const std::string& recording, const RecordedSpan& span, Duration to,
                      const std::string& out) {
  auto reader = RecordingReader::open(recording, span.run.id);
  if (!reader) return tl::unexpected(reader.error());
  auto writer = RecordingWriter::open(out, span.run, Duration::max());
  if (!writer) return tl::unexpected(writer.error());
  for (;;) {
    auto event = reader->next();
    if (!event) return tl::unexpected(event.error());
    const bool in_window = *event && (to == Duration::max() || (*event)->end - span.origin <= to);
    if (!in_window) break;
    (*writer)->append(std::move(**event));
  }
  (*writer)->flush();
  if ((*writer)->trouble()) return tl::unexpected(*(*writer)->trouble());
  return {};
}

Result<void> add_contents(const CapsuleRequest& request, CampaignId campaign,
                          const std::string& unfinished, const std::string& note) {
  const auto folder = ScratchFolder::make();
  if (!folder) return tl::unexpected(folder.error());
  CampaignSlice slice{campaign};
  slice.t_last_ns = request.to.count();
  const std::string database = *folder / "slice.db";
  if (auto cut = cut_out_campaign(request.database, database, slice); !cut) return cut;
  auto capsule = RecordingDatabase::open_to_write(unfinished);
  if (!capsule) return tl::unexpected(capsule.error());
  if (auto put = put_contents(*capsule, database, note); !put) return put;
  capsule->close_tidily();
  return {};
}

Result<void> expect_free(const std::string& path) {
  if (!std::filesystem::exists(path)) return {};
  return fail(Errc::busy, path + ": exists already", "choose another name or move that file away");
}

}  // namespace

Result<Capsule> cut_capsule(const CapsuleRequest& request) {
  if (auto free = expect_free(request.out); !free) return tl::unexpected(free.error());
  const auto campaign = chosen_campaign(request);
  if (!campaign) return tl::unexpected(campaign.error());
  const std::string recording =
      request.recording.empty() ? runner::recording_path(request.database) : request.recording;
  const auto spans = spans_in_window(recording, *campaign, request);
  if (!spans) return tl::unexpected(spans.error());

  Capsule capsule;
  capsule.runs = static_cast<std::int64_t>(spans->size());
  capsule.from = spans->front().from;
  capsule.to = std::min(spans->back().to, request.to);
  capsule.note = fmt::format("campaign {}, {} to {}, cut out by gyrocal {}",
                             static_cast<std::int64_t>(*campaign), clock_text(capsule.from),
                             clock_text(capsule.to), request.software_version);
  const std::string unfinished = request.out + ".unfinished";
  std::error_code ignored;  // what cannot be removed shows as an existing file
  std::filesystem::remove(unfinished, ignored);
  Result<void> done;
  for (const RecordedSpan& span : *spans) {
    if (done) done = copy_run(recording, span, request.to, unfinished);
  }
  if (done) done = add_contents(request, *campaign, unfinished, capsule.note);
  if (!done) {
    std::filesystem::remove(unfinished, ignored);
    return tl::unexpected(done.error());
  }
  std::filesystem::rename(unfinished, request.out, ignored);
  if (ignored) {
    return fail(Errc::storage, fmt::format("write {}: {}", request.out, ignored.message()));
  }
  capsule.bytes = std::filesystem::file_size(request.out, ignored);
  return capsule;
}

}  // namespace gyrocal::replay
