#include "image/exr_selection.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <span>
#include <string_view>

namespace shoal {
namespace {

constexpr std::size_t kListedNames = 24;

// Names come out of the file: nothing that a terminal would obey may get into a message.
std::string printable(std::string_view name) {
  std::string text(name);
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  return text;
}

std::string joined(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kListedNames); ++i) {
    text += (i == 0 ? "" : ", ") + printable(names[i]);
  }
  if (names.size() > kListedNames) {
    text += " and " + std::to_string(names.size() - kListedNames) + " more";
  }
  return text;
}

std::optional<int> find_channel(const ExrPart& part, const std::string& layer,
                                std::string_view name) {
  const std::string full = layer.empty() ? std::string(name) : layer + "." + std::string(name);
  for (std::size_t i = 0; i < part.channels.size(); ++i) {
    if (part.channels[i].name == full) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::optional<ExrColour> find_colour(const ExrPart& part, const std::string& layer) {
  const auto r = find_channel(part, layer, "R");
  const auto g = find_channel(part, layer, "G");
  const auto b = find_channel(part, layer, "B");
  if (r && g && b) return ExrColour{ExrColourModel::rgb, {*r, *g, *b}};
  const auto y = find_channel(part, layer, "Y");
  const auto ry = find_channel(part, layer, "RY");
  const auto by = find_channel(part, layer, "BY");
  if (y && ry && by) return ExrColour{ExrColourModel::luminance_chroma, {*y, *ry, *by}};
  if (y) return ExrColour{ExrColourModel::grey, {*y, *y, *y}};
  return std::nullopt;
}

// The layers of a part that have colour, for the hint.
std::vector<std::string> layers_with_colour(const ExrPart& part) {
  std::set<std::string> layers;
  for (const ExrChannel& channel : part.channels) {
    const std::size_t dot = channel.name.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string layer = channel.name.substr(0, dot);
    if (!layers.contains(layer) && find_colour(part, layer)) layers.insert(layer);
  }
  return {layers.begin(), layers.end()};
}

// Why a part is no panorama that can be read, whatever its channels are; empty if it may be one.
std::string unsuitable(const ExrPart& part) {
  if (part.storage == ExrStorage::deep) {
    return "holds deep data (several samples a pixel), which is not read";
  }
  return "";
}

// Why the chosen channels cannot be read; empty if they can.
std::string unsuitable(const ExrPart& part, const ExrColour& colour) {
  if (colour.model == ExrColourModel::luminance_chroma) {
    // The library's conversion to RGB opens the first part only.
    return part.index == 0 ? "" : "holds luminance and chroma in a part other than the first";
  }
  for (int i = 0; i < colour.channel_count(); ++i) {
    const ExrChannel& channel = part.channels[colour.channels[i]];
    if (channel.is_subsampled()) {
      return "has its channel " + printable(channel.name) + " at reduced resolution (" +
             std::to_string(channel.x_sampling) + " x " + std::to_string(channel.y_sampling) +
             "), which is read for chroma only";
    }
  }
  return "";
}

std::string part_title(const ExrPart& part) {
  return part.name.empty() ? std::to_string(part.index) : printable(part.name);
}

Result<int> find_part(const std::vector<ExrPart>& parts, const std::string& wanted,
                      const std::string& path) {
  std::vector<std::string> names;
  for (const ExrPart& part : parts) {
    if (part.name == wanted) return part.index;
    names.push_back(part_title(part));
  }
  std::size_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [stop, status] = std::from_chars(wanted.data(), end, number);
  if (status == std::errc{} && stop == end && number < parts.size()) {
    return static_cast<int>(number);
  }
  return Error{ErrorCode::usage, "has no part \"" + wanted + "\"", path,
               "its parts, numbered from 0, are " + joined(names)};
}

Error no_colour(const ExrPart& part, const std::string& layer, const std::string& path) {
  std::vector<std::string> names;
  for (const ExrChannel& channel : part.channels) names.push_back(channel.name);
  const std::vector<std::string> layers = layers_with_colour(part);
  const std::string hint = layers.empty() ? "" : "set layer: to one of " + joined(layers);
  const std::string listed = "; its channels are " + joined(names);
  if (!layer.empty()) {
    return {ErrorCode::usage, "has no channels R, G, B or Y in a layer \"" + layer + "\"" + listed,
            path, hint.empty() ? "leave layer: out" : hint};
  }
  return {ErrorCode::unsupported, "has no channels R, G, B and no channel Y" + listed, path,
          hint.empty() ? "a colour picture is needed" : hint};
}

Result<ExrSelection> select_in_part(const ExrPart& part, const std::string& layer,
                                    const std::string& path) {
  std::string reason = unsuitable(part);
  if (!reason.empty()) return Error{ErrorCode::unsupported, reason, path, ""};
  const auto colour = find_colour(part, layer);
  if (!colour) return no_colour(part, layer, path);
  reason = unsuitable(part, *colour);
  if (!reason.empty()) return Error{ErrorCode::unsupported, reason, path, ""};
  return ExrSelection{part.index, *colour};
}

}  // namespace

Result<ExrSelection> select_exr_colour(const std::vector<ExrPart>& parts,
                                       const ReadOptions& options, const std::string& path) {
  if (!options.part.empty()) {
    SHOAL_ASSIGN_OR_RETURN(index, find_part(parts, options.part, path));
    return select_in_part(parts[index], options.layer, path);
  }
  std::optional<ExrSelection> grey;
  std::optional<int> first_with_colour;
  for (const ExrPart& part : parts) {
    if (!first_with_colour && find_colour(part, options.layer)) first_with_colour = part.index;
    const auto selection = select_in_part(part, options.layer, path);
    if (!selection) continue;
    if (selection->colour.model != ExrColourModel::grey) return *selection;
    if (!grey) grey = *selection;
  }
  if (grey) return *grey;
  // Nothing fits: what is told is why the most promising part does not.
  return select_in_part(parts[first_with_colour.value_or(0)], options.layer, path);
}

}  // namespace shoal
