// What a variant makes of an entry's linear keys.
#include <algorithm>
#include <utility>

#include "batch/manifest.h"

namespace shoal {

ColourOperations colour_of(const EntrySettings& settings, const Variant& variant) {
  const LinearKeys& base = settings.linear;
  const LinearKeys& over = variant.linear;
  ColourOperations colour;
  colour.exposure_stops = over.exposure_stops.value_or(base.exposure_stops.value_or(0.0));
  colour.scale = over.scale.value_or(base.scale.value_or(1.0));
  colour.matrix = over.matrix.value_or(base.matrix.value_or(glm::dmat3(1.0)));
  colour.white = over.white ? over.white : base.white;
  return colour;
}

Frame frame_of(const EntrySettings& settings, const Variant& variant) {
  return variant.linear.frame.value_or(settings.linear.frame.value_or(Frame{}));
}

Result<glm::dmat3> turn_of(const EntrySettings& settings, const Variant& variant) {
  const std::optional<TurnKey>& turn =
      variant.linear.turn ? variant.linear.turn : settings.linear.turn;
  const Frame frame = frame_of(settings, variant);
  Result<glm::dmat3> matrix = glm::dmat3(1.0);
  if (turn) {
    if (const auto* picture = std::get_if<PictureTurn>(&*turn)) matrix = turn_matrix(*picture);
    if (const auto* about = std::get_if<AxisTurn>(&*turn)) {
      matrix = axis_turn(about->axis, about->angle, frame);
    }
    if (const auto* quaternion = std::get_if<glm::dquat>(&*turn)) {
      matrix = quaternion_turn(*quaternion, frame);
    }
  }
  if (matrix && variant.view) matrix = *variant.view * *matrix;
  return matrix;
}

// The picture's right is -y.
glm::dmat3 mirror_of(const EntrySettings& settings, const Variant& variant) {
  const Mirror mirror =
      variant.linear.mirror.value_or(settings.linear.mirror.value_or(Mirror::none));
  glm::dmat3 matrix(1.0);
  if (mirror == Mirror::left_right) matrix[1][1] = -1.0;
  return matrix;
}

bool asks_for(const Manifest& manifest, FigureTable table) {
  return std::ranges::find(manifest.figure_tables, table) != manifest.figure_tables.end();
}

bool wants_quality(const Manifest& manifest, const EntrySettings& settings) {
  const ProjectionSettings& projection = settings.projection;
  return projection.highest_degree() > projection.degree ||
         asks_for(manifest, FigureTable::quality);
}

WindowKey window_of(const EntrySettings& settings, const Variant& variant) {
  return variant.linear.window.value_or(settings.linear.window.value_or(WindowKey{}));
}

DominantPart dominant_of(const EntrySettings& settings, const Variant& variant) {
  return variant.linear.dominant.value_or(settings.linear.dominant.value_or(DominantPart::keep));
}

std::vector<AnalyticLight> native_lights(const EntrySettings& settings) {
  const glm::dmat3 to_native =
      glm::transpose(native_to_frame(settings.linear.frame.value_or(Frame{})));
  std::vector<AnalyticLight> lights;
  for (const AnalyticLight& light : settings.lights) lights.push_back(turned(light, to_native));
  return lights;
}

}  // namespace shoal
