// Every stage of decoding, in bytes of the file (stages: of what comes out) and in pixels a second,
// beside plain positioned reads of the same file.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <libdeflate.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <map>

#include "bench/exr_chunks.h"
#include "bench/panorama_file.h"
#include "image/exr_inflate.h"
#include "image/panorama_source.h"
#include "image/radiance_rle.h"
#include "image/zlib_inflater.h"
#include "kernels/byte_planes.h"
#include "kernels/wavelet.h"
#include "support/temporary_folder.h"

namespace shoal::bench {
namespace {

constexpr int kWidth = 2048;
constexpr int kHeight = 1024;
constexpr ChunkCodecs kCodecs = {kernels::undo_predictor_and_split, kernels::undo_wavelet,
                                 kernels::sum_planes};
constexpr std::int64_t kPixels = std::int64_t{kWidth} * kHeight;

// The file of a kind, made when it is first asked for; empty if that failed.
const std::string& file_of(const std::string& kind) {
  static const test::TemporaryFolder folder;
  static std::map<std::string, std::string> made;
  const auto [entry, is_new] = made.try_emplace(kind);
  const std::filesystem::path path = folder / kind;
  if (is_new && make_panorama_files(kWidth, kHeight, 1, {{kind, path}})) {
    entry->second = path.string();
  }
  return entry->second;
}

void count_work(benchmark::State& state, std::uint64_t bytes) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
  state.SetItemsProcessed(state.iterations() * kPixels);
}

void read_plainly(benchmark::State& state, const std::string& kind) {
  const std::string& path = file_of(kind);
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return state.SkipWithError("no file");
  std::vector<std::byte> block(std::size_t{1} << 18);
  std::uint64_t size = 0;
  for (auto iteration : state) {
    size = 0;
    for (;;) {
      const ssize_t got = ::pread(descriptor, block.data(), block.size(), static_cast<off_t>(size));
      if (got <= 0) break;
      size += static_cast<std::uint64_t>(got);
    }
  }
  ::close(descriptor);
  count_work(state, size);
}

Status read_bands(const std::string& path) {
  SHOAL_ASSIGN_OR_RETURN(source, open_panorama(path, {}, kCodecs));
  SHOAL_ASSIGN_OR_RETURN(reader, source->new_reader());
  for (int i = 0; i < source->info().band_count; ++i) {
    SHOAL_ASSIGN_OR_RETURN(band, reader->read(i));
    benchmark::DoNotOptimize(band);
  }
  return {};
}

void open_and_read_bands(benchmark::State& state, const std::string& kind) {
  const std::string& path = file_of(kind);
  for (auto iteration : state) {
    if (const Status read = read_bands(path); !read) {
      return state.SkipWithError(read.error().text().c_str());
    }
  }
  count_work(state, std::filesystem::file_size(path));
}

void inflate_chunks(benchmark::State& state, const std::string& kind) {
  const auto file = read_exr_chunks(file_of(kind));
  if (!file) return state.SkipWithError(file.error().text().c_str());
  libdeflate_decompressor* inflater = libdeflate_alloc_decompressor();
  std::vector<std::byte> out(file->largest_unpacked);
  for (auto iteration : state) {
    for (const auto& chunk : file->chunks) {
      libdeflate_zlib_decompress(inflater, file->packed(chunk).data(), chunk.packed_size,
                                 out.data(), chunk.unpacked_size, nullptr);
    }
    benchmark::ClobberMemory();
  }
  libdeflate_free_decompressor(inflater);
  count_work(state, file->unpacked_total);
}

// As many chunks as a band has, of ZIP, where they are not very large.
constexpr std::size_t kChunksTogether = 4;

std::span<const ExrChunks::Chunk> chunks_from(const ExrChunks& file, std::size_t begin) {
  const std::size_t left = file.chunks.size() - begin;
  return std::span(file.chunks).subspan(begin, std::min(left, kChunksTogether));
}

// What inflate_chunks does, by our own decoder.
void inflate_chunks_in_lanes(benchmark::State& state, const std::string& kind) {
  const auto file = read_exr_chunks(file_of(kind));
  if (!file) return state.SkipWithError(file.error().text().c_str());
  ZlibInflater inflater;
  std::vector<ZlibInflater::Job> jobs;
  const auto leave = [](std::size_t, std::span<std::byte>) {};
  for (auto iteration : state) {
    for (std::size_t begin = 0; begin < file->chunks.size(); begin += kChunksTogether) {
      jobs.clear();
      for (const auto& chunk : chunks_from(*file, begin)) {
        jobs.push_back({file->packed(chunk), chunk.unpacked_size});
      }
      benchmark::DoNotOptimize(inflater.inflate(jobs, leave));
    }
    benchmark::ClobberMemory();
  }
  count_work(state, file->unpacked_total);
}

void expand_chunks(benchmark::State& state, const std::string& kind,
                   exr_compression_t compression) {
  const auto file = read_exr_chunks(file_of(kind));
  if (!file) return state.SkipWithError(file.error().text().c_str());
  ExrInflater inflater(compression, kCodecs);
  const std::array<SampleType, 3> types =
      kind.starts_with("half")
          ? std::array{SampleType::half, SampleType::half, SampleType::half}
          : std::array{SampleType::float32, SampleType::float32, SampleType::float32};
  const std::size_t row_bytes = 3 * kWidth * sample_size(types[0]);
  std::vector<std::byte> out(kChunksTogether * file->largest_unpacked);
  std::vector<ExrInflater::Chunk> together;
  for (auto iteration : state) {
    for (std::size_t begin = 0; begin < file->chunks.size(); begin += kChunksTogether) {
      together.clear();
      for (const auto& chunk : chunks_from(*file, begin)) {
        const auto room =
            std::span(out).subspan(together.size() * file->largest_unpacked, chunk.unpacked_size);
        together.push_back({file->packed(chunk), {types, kWidth, room.size() / row_bytes}, room});
      }
      if (inflater.expand(together) != together.size()) {
        return state.SkipWithError("a chunk does not expand");
      }
    }
    benchmark::ClobberMemory();
  }
  count_work(state, file->unpacked_total);
}

void expand_exr_run_lengths(benchmark::State& state) {
  const auto file = read_exr_chunks(file_of("half-rle"));
  if (!file) return state.SkipWithError(file.error().text().c_str());
  std::vector<std::byte> out(file->largest_unpacked);
  for (auto iteration : state) {
    for (const auto& chunk : file->chunks) {
      if (chunk.packed_size == chunk.unpacked_size) continue;
      benchmark::DoNotOptimize(
          expand_exr_runs(file->packed(chunk), std::span(out).first(chunk.unpacked_size)));
    }
    benchmark::ClobberMemory();
  }
  count_work(state, file->unpacked_total);
}

// The scanlines of the file in memory; its header ends with a line that begins with "-Y".
void expand_radiance_scanlines(benchmark::State& state) {
  std::ifstream stream(file_of("hdr"), std::ios::binary);
  std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(stream), {});
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t begin = text.find('\n', text.find("\n-Y ") + 1) + 1;
  const std::size_t size = bytes.size();
  bytes.resize(size + kRadianceSlack);
  std::array<std::vector<std::uint8_t>, 4> planes;
  for (auto& plane : planes) plane.resize(kWidth + kRadianceSlack);
  for (auto iteration : state) {
    std::size_t at = begin;
    for (int row = 0; row < kHeight; ++row) {
      const auto result = expand_radiance_scanline(
          std::span(bytes).subspan(at, size - at), kWidth, DataSize::any,
          {planes[0].data(), planes[1].data(), planes[2].data(), planes[3].data()});
      if (result.state != ScanlineState::whole) return state.SkipWithError("a scanline breaks");
      at += result.bytes;
    }
    benchmark::ClobberMemory();
  }
  count_work(state, 4 * kPixels);
}

// Registered here because the kinds are a list that panorama_file.h owns.
const bool kRegistered = [] {
  const std::map<std::string, exr_compression_t> expanded = {
      {"half-zips", EXR_COMPRESSION_ZIPS}, {"half-zip", EXR_COMPRESSION_ZIP},
      {"float-zip", EXR_COMPRESSION_ZIP},  {"half-rle", EXR_COMPRESSION_RLE},
      {"half-piz", EXR_COMPRESSION_PIZ},   {"half-pxr24", EXR_COMPRESSION_PXR24}};
  for (const std::string& kind : panorama_file_kinds()) {
    if (kind.starts_with("float-") && kind != "float-none" && kind != "float-zip") continue;
    benchmark::RegisterBenchmark(("read_plainly/" + kind).c_str(), read_plainly, kind);
    benchmark::RegisterBenchmark(("read_bands/" + kind).c_str(), open_and_read_bands, kind);
  }
  for (const auto& [kind, compression] : expanded) {
    if (kind.find("-zip") != std::string::npos) {
      benchmark::RegisterBenchmark(("inflate_chunks/" + kind).c_str(), inflate_chunks, kind);
      benchmark::RegisterBenchmark(("inflate_chunks_in_lanes/" + kind).c_str(),
                                   inflate_chunks_in_lanes, kind);
    }
    benchmark::RegisterBenchmark(("expand_chunks/" + kind).c_str(), expand_chunks, kind,
                                 compression);
  }
  return true;
}();

BENCHMARK(expand_exr_run_lengths);
BENCHMARK(expand_radiance_scanlines);

}  // namespace
}  // namespace shoal::bench
