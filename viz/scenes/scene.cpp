#include "scenes/scene.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "scenes/scene_parts.h"

namespace shoal::viz {
namespace {

struct SceneEntry {
  SceneKind kind;
  std::string_view name;
  Status (*show)(const SceneInput&, Stage&);
};

constexpr SceneEntry kScenes[] = {
    {SceneKind::basis, "basis", show_basis_scene},
    {SceneKind::lobes, "lobes", show_lobes_scene},
    {SceneKind::sphere, "sphere", show_sphere_scene},
    {SceneKind::degrees, "degrees", show_degrees_scene},
    {SceneKind::lit, "lit", show_lit_scene},
    {SceneKind::compare, "compare", show_compare_scene},
    {SceneKind::contact, "contact", show_contact_scene},
};

const SceneEntry& entry_of(SceneKind kind) {
  return *std::find_if(std::begin(kScenes), std::end(kScenes),
                       [&](const SceneEntry& entry) { return entry.kind == kind; });
}

}  // namespace

std::string_view name_of(SceneKind kind) { return entry_of(kind).name; }

Result<SceneKind> parse_scene(std::string_view name) {
  std::vector<std::string_view> names;
  std::string list;
  for (const SceneEntry& entry : kScenes) {
    if (entry.name == name) return entry.kind;
    names.push_back(entry.name);
    list += (list.empty() ? "" : ", ") + std::string(entry.name);
  }
  const std::string_view near = closest_match(name, names);
  return Error{
      ErrorCode::usage, "there is no scene \"" + std::string(name) + '"', "",
      near.empty() ? "the scenes are " + list : "did you mean \"" + std::string(near) + "\"?"};
}

Status show_scene(SceneKind kind, const SceneInput& input, vtkRenderWindow& window) {
  const bool needs_panorama = kind != SceneKind::basis;
  if (needs_panorama && input.library->panoramas.empty()) {
    return Error{ErrorCode::usage, "the library has no panorama to show", "",
                 "name an output folder, a table or a panorama"};
  }
  Stage stage(window);
  return entry_of(kind).show(input, stage);
}

}  // namespace shoal::viz
