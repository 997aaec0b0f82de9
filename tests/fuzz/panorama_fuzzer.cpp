// Any bytes as an EXR or a Radiance file: a projection or an error, never a crash. Both are the
// same for one worker and for three, and what plain loops read is what SIMD reads, bit by bit.
#include <atomic>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "image/panorama_source.h"
#include "transform/projector.h"
#include "transform/simd_codecs.h"

namespace shoal::test {
namespace {

constexpr std::int64_t kMostPixels = 1 << 18;  // more take the fuzzer's time and show no more

// Of other formats OpenImageIO's readers are the ones to fuzz.
bool is_ours(std::string_view bytes) {
  return bytes.starts_with("\x76\x2f\x31\x01") || bytes.starts_with("#?");
}

void append_samples(const Plane& plane, const RowBand& band, std::string& bytes) {
  if (plane.data == nullptr) return;
  for (int row = 0; row < band.row_count(); ++row) {
    bytes.append(reinterpret_cast<const char*>(plane.row(row)),
                 static_cast<std::size_t>(band.width) * sample_size(plane.type));
  }
}

// Everything that reading gives, errors too: a reader goes on behind a band that is damaged.
std::string read_everything(const PanoramaSource& source) {
  auto reader = source.new_reader();
  if (!reader) return reader.error().text();
  std::string read;
  for (int index = 0; index < source.info().band_count; ++index) {
    const auto band = (*reader)->read(index);
    if (!band) {
      read += band.error().text();
      continue;
    }
    for (int c = 0; c < band->channel_count; ++c) append_samples(band->channels[c], *band, read);
    append_samples(band->exponent, *band, read);
  }
  return read;
}

std::string told(const Result<Projection>& projection) {
  if (!projection) return projection.error().text();
  std::string text;
  for (const auto& channel : projection->radiance.channels) {
    text.append(reinterpret_cast<const char*>(channel.data()), channel.size() * sizeof(double));
  }
  for (const std::string& warning : projection->warnings) text += warning;
  return text;
}

Result<Projection> project_together(const std::filesystem::path& path, int worker_count,
                                    const ProjectionSettings& settings, ProjectionTables& tables) {
  SHOAL_ASSIGN_OR_RETURN(projection, PanoramaProjection::open(path, {}, settings, tables));
  const std::atomic<bool> stop = false;
  std::atomic<std::int64_t> pixels_done = 0;
  std::vector<Status> outcomes(worker_count);
  {
    std::vector<std::jthread> workers;
    for (Status& outcome : outcomes) {
      workers.emplace_back([&] { outcome = projection->work(stop, pixels_done); });
    }
  }
  for (const Status& outcome : outcomes) SHOAL_RETURN_IF_ERROR(outcome);
  return projection->finish();
}

void check(const std::filesystem::path& path) {
  ReadOptions options;
  options.rows_per_band = 3;
  const auto plain = open_panorama(path, options, portable_chunk_codecs());
  const auto fast = open_panorama(path, options, simd_chunk_codecs());
  demand(bool(plain) == bool(fast), "both codecs open it, or neither");
  if (!plain) return;
  const PictureInfo& info = (*plain)->info();
  if (std::int64_t{info.width} * info.height > kMostPixels) return;
  // OpenEXR's DWA decoder (3.1) leaves memory as it finds it where a file is damaged, and hands it
  // out as samples: such a file does not even read as itself.
  if (info.format.find("DWA") != info.format.npos) return;
  demand(read_everything(**plain) == read_everything(**fast), "plain loops and SIMD read the same");

  static ProjectionTables tables;
  ProjectionSettings settings;
  settings.layout = Layout::automatic;
  const auto alone = project_panorama(path, {}, settings, tables);
  const auto together = project_together(path, 3, settings, tables);
  demand(bool(alone) == bool(together), "one worker and three agree that it is sound");
  // Of several errors, workers in a hurry may tell another one first.
  if (alone) demand(told(alone) == told(together), "one worker and three tell the same");
}

}  // namespace
}  // namespace shoal::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (!shoal::test::is_ours({reinterpret_cast<const char*>(data), size})) return 0;
  const shoal::test::MemoryFile file({data, size});
  shoal::test::check(file.path());
  return 0;
}
