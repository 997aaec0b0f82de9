// The keys of rotations, of views, and of windows over degrees.
#include <limits>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

using Limits = std::numeric_limits<double>;
constexpr NumberRule kDegrees{Limits::lowest(), Limits::max(), "a number of degrees of arc"};
constexpr NumberRule kAnyNumber{Limits::lowest(), Limits::max(), "a number"};
constexpr IntegerRule kViewCount{1, 10'000};

template <std::optional<double> TurnText::*kAngle>
void read_angle(const ManifestReader& reader, const Field& field, TurnText& turn) {
  assign(reader.number(field, kDegrees), turn.*kAngle);
}

const ManifestKeyRule<TurnText> kTurnRules[] = {
    {"yaw", read_angle<&TurnText::yaw>},
    {"pitch", read_angle<&TurnText::pitch>},
    {"roll", read_angle<&TurnText::roll>},
    {"axis",
     [](const ManifestReader& reader, const Field& field, TurnText& turn) {
       assign(reader.numbers(field, 3, kAnyNumber, "a list of three numbers"), turn.axis);
     }},
    {"angle", read_angle<&TurnText::angle>},
    {"quaternion",
     [](const ManifestReader& reader, const Field& field, TurnText& turn) {
       assign(reader.numbers(field, 4, kAnyNumber, "a list of four numbers: w, x, y, z"),
              turn.quaternion);
     }},
};

template <WindowKind kKind>
void read_parameter(const ManifestReader& reader, const Field& field, WindowKey& window) {
  const std::optional<double> parameter = reader.number(field, kAnyNumber);
  if (!parameter) return;
  window.window = {kKind, *parameter};
  if (Status status = check_window(window.window); !status) {
    reader.error(field.value, status.error().what, status.error().hint);
  }
}

const ManifestKeyRule<WindowKey> kWindowRules[] = {
    {"hann", read_parameter<WindowKind::hann>},
    {"lanczos", read_parameter<WindowKind::lanczos>},
    {"gauss", read_parameter<WindowKind::gauss>},
    {"laplacian", read_parameter<WindowKind::laplacian>},
};

constexpr Choice<ViewsOver> kViewsOver[] = {{"yaw", ViewsOver::yaw}, {"all", ViewsOver::all}};

const ManifestKeyRule<ViewsKey> kViewsRules[] = {
    {"count", [](const ManifestReader& reader, const Field& field,
                 ViewsKey& views) { assign(reader.integer(field, kViewCount), views.count); }},
    {"over",
     [](const ManifestReader& reader, const Field& field, ViewsKey& views) {
       assign(reader.choice<ViewsOver>(field, kViewsOver), views.over);
     },
     choice_names<kViewsOver>},
};

void read_views(const ManifestReader& reader, const Field& field, ViewsKey& views) {
  if (field.value.IsMap()) {
    read_mapping(reader, field.value, kViewsMapping, KeyTarget<ViewsKey>{kViewsRules, &views});
    if (views.count == 0) reader.error(field.value, "views needs a count", "say views: 16");
    return;
  }
  assign(reader.integer(field, kViewCount), views.count);
}

const ManifestKeyRule<ViewsKey> kVariantRules[] = {{"views", read_views}};

}  // namespace

std::span<const ManifestKeyRule<TurnText>> turn_rules() { return kTurnRules; }
std::span<const ManifestKeyRule<WindowKey>> window_rules() { return kWindowRules; }
std::span<const ManifestKeyRule<ViewsKey>> views_rules() { return kViewsRules; }
std::span<const ManifestKeyRule<ViewsKey>> variant_rules() { return kVariantRules; }

std::optional<TurnKey> read_turn(const ManifestReader& reader, const Field& field) {
  TurnText turn;
  if (!read_mapping(reader, field.value, kTurnMapping, KeyTarget<TurnText>{kTurnRules, &turn})) {
    return std::nullopt;
  }
  const bool by_picture = turn.yaw || turn.pitch || turn.roll;
  const bool by_axis = turn.axis || turn.angle;
  const bool by_quaternion = turn.quaternion.has_value();
  if (int{by_picture} + int{by_axis} + int{by_quaternion} > 1) {
    reader.error(field.value, "rotate mixes two ways to tell a rotation",
                 "either yaw, pitch and roll, or axis and angle, or quaternion");
    return std::nullopt;
  }
  if (by_axis && (!turn.axis || !turn.angle)) {
    reader.error(field.value, "axis and angle go together", "such as {axis: [0, 1, 0], angle: 90}");
    return std::nullopt;
  }
  if (by_quaternion) {
    const std::vector<double>& q = *turn.quaternion;
    return TurnKey{glm::dquat(q[0], q[1], q[2], q[3])};
  }
  if (by_axis) {
    const std::vector<double>& a = *turn.axis;
    return TurnKey{AxisTurn{{a[0], a[1], a[2]}, *turn.angle}};
  }
  return TurnKey{
      PictureTurn{turn.yaw.value_or(0.0), turn.pitch.value_or(0.0), turn.roll.value_or(0.0)}};
}

std::optional<WindowKey> read_window(const ManifestReader& reader, const Field& field) {
  if (field.value.IsMap()) {
    WindowKey window;
    if (!read_mapping(reader, field.value, kWindowMapping,
                      KeyTarget<WindowKey>{kWindowRules, &window})) {
      return std::nullopt;
    }
    if (field.value.size() == 1) return window;
    reader.error(field.value, "a window is one kind with its parameter", "such as {hann: 4}");
    return std::nullopt;
  }
  return reader.choice<WindowKey>(field, kWindowWords);
}

}  // namespace shoal
