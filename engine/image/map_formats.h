// The writers behind MapWriter::create(), one a format. `file` was checked there.
#pragma once

#include "core/atomic_file.h"
#include "image/map_writer.h"

namespace shoal {

using MapWriterResult = Result<std::unique_ptr<MapWriter>>;

MapWriterResult create_exr_map(const std::filesystem::path& path, const MapFile& file);
MapWriterResult create_hdr_map(const std::filesystem::path& path, const MapFile& file);
MapWriterResult create_png_map(const std::filesystem::path& path, const MapFile& file);

}  // namespace shoal
