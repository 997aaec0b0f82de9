#include "image/exr_band_reader.h"

#include <algorithm>

namespace shoal {

std::string ExrPicture::where(int row) const {
  return context->file().path() + ":" + std::to_string(std::clamp(row, 0, layout.height - 1));
}

SampleType ExrPicture::sample_type(int channel) const {
  if (colour.model == ExrColourModel::luminance_chroma) return SampleType::half;
  return part.channels[colour.channels[channel]].type;
}

ExrBandReader::ExrBandReader(std::shared_ptr<const ExrPicture> picture)
    : picture_(std::move(picture)) {}

Result<RowBand> ExrBandReader::read(int index) {
  if (index < 0 || index >= layout().band_count()) {
    return Error{ErrorCode::internal, "there is no band " + std::to_string(index),
                 picture().context->file().path(), ""};
  }
  const ExrBand band = layout().band(index);
  RowBand rows;
  rows.row_begin = band.row_begin;
  rows.row_end = band.row_end;
  rows.width = layout().width;
  rows.channel_count = picture().colour.channel_count();
  for (int c = 0; c < rows.channel_count; ++c) rows.channels[c].type = picture().sample_type(c);

  if (!band.is_black()) {
    SHOAL_RETURN_IF_ERROR(decode(band, rows));
    return rows;
  }
  if (black_row_.size() == 0) {
    black_row_.resize_zeroed(static_cast<std::size_t>(rows.width) * sizeof(float));
  }
  for (int c = 0; c < rows.channel_count; ++c) rows.channels[c].data = black_row_.data();
  return rows;
}

ExrPlanarRows::ExrPlanarRows(const ExrPicture& picture) : layout_(picture.layout) {
  left_ = std::min(0, layout_.data_x);
  const int right = std::max(layout_.width, layout_.data_x + layout_.data_width);
  std::size_t size = 0;
  for (int c = 0; c < picture.colour.channel_count(); ++c) {
    Channel& channel = channels_[c];
    channel.sample_bytes = static_cast<std::ptrdiff_t>(sample_size(picture.sample_type(c)));
    channel.stride = (right - left_) * channel.sample_bytes;
    channel.offset = size;
    size += static_cast<std::size_t>(channel.stride) *
            static_cast<std::size_t>(layout_.rows_per_band());
  }
  samples_.resize_zeroed(size);
}

std::byte* ExrPlanarRows::sample(int channel, int row, int column) {
  const Channel& at = channels_[channel];
  return samples_.data() + at.offset + row * at.stride +
         (layout_.data_x - left_ + column) * at.sample_bytes;
}

void ExrPlanarRows::show(const ExrBand& band, RowBand& rows) const {
  const int skipped = band.row_begin - layout_.row_of_chunk(band.chunk_begin);
  for (int c = 0; c < rows.channel_count; ++c) {
    const Channel& at = channels_[c];
    rows.channels[c].data =
        samples_.data() + at.offset + skipped * at.stride - left_ * at.sample_bytes;
    rows.channels[c].row_stride = at.stride;
  }
}

}  // namespace shoal
