#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "library/light.h"
#include "library/viewpoint.h"
#include "scenes/actors.h"
#include "scenes/axes.h"
#include "scenes/exhibits.h"
#include "scenes/legends.h"
#include "scenes/lighting.h"
#include "scenes/scene_parts.h"
#include "scenes/shared_camera.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

constexpr int kReferenceWidth = 1024;  // of the pixels that are summed, at most
constexpr double kAlbedo = 0.8;
constexpr double kSceneRadius = 1.32;
constexpr double kLeastScale = 0.01;  // of the mean: less is not to be looked at

using Light = std::vector<std::vector<glm::dvec3>>;  // irradiance a vertex of each mesh, RGB

// The objects as the viewer sees them, in drawn coordinates: the bust behind, a ball and a torus
// before it at either side.
std::vector<Mesh> exhibits(const Frame& frame) {
  const struct {
    Mesh mesh;
    float size;
    glm::vec3 place;  // to the right, away, up
  } things[] = {{sphere_mesh(44), 0.52f, {-0.66f, -0.35f, -0.72f}},
                {torus_mesh(), 0.62f, {0.66f, -0.35f, -0.72f}},
                {bust_mesh(), 1.0f, {0.0f, 0.3f, 0.42f}}};
  const glm::vec3 up(native_to_frame(frame) * glm::dvec3(0.0, 0.0, 1.0));
  const glm::vec3 right = glm::normalize(glm::cross(up, glm::vec3(viewer_direction(frame))));
  const glm::vec3 away = glm::cross(up, right);
  const auto turned = [&](const glm::vec3& p) { return p.x * right + p.y * away + p.z * up; };
  std::vector<Mesh> meshes;
  for (const auto& thing : things) {
    Mesh& mesh = meshes.emplace_back(thing.mesh);
    for (glm::vec3& p : mesh.positions) p = turned(thing.size * p + thing.place);
    for (glm::vec3& n : mesh.normals) n = turned(n);
  }
  return meshes;
}

double luminance(const glm::dvec3& light) { return channel_of(light, Channel::luminance); }

struct Comparison {
  std::string form_is;       // "nine coefficients"
  std::string reference_is;  // the integral of what
  Light form;
  Light reference;       // empty without pixels
  double mean = 0.0;     // luminance of the reference, over the ball's surface
  double rms = 0.0;      // of form - reference, likewise
  double largest = 0.0;  // |form - reference| of all vertices
};

// The share of the surface around each vertex: a third of its triangles.
std::vector<double> shares_of(const Mesh& mesh) {
  std::vector<double> shares(mesh.positions.size(), 0.0);
  double whole = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double area = glm::length(
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    for (const std::uint32_t vertex : {a, b, c}) shares[vertex] += area / 3.0;
    whole += area;
  }
  for (double& share : shares) share /= whole;
  return shares;
}

// The ball, the first mesh, has normals of all directions.
void measure(const Mesh& ball, Comparison& comparison) {
  const std::vector<double> shares = shares_of(ball);
  for (std::size_t mesh = 0; mesh < comparison.form.size(); ++mesh) {
    for (std::size_t i = 0; i < comparison.form[mesh].size(); ++i) {
      const double expected = luminance(comparison.reference[mesh][i]);
      const double error = luminance(comparison.form[mesh][i]) - expected;
      comparison.largest = std::max(comparison.largest, std::abs(error));
      if (mesh > 0) continue;
      comparison.mean += shares[i] * expected;
      comparison.rms += shares[i] * error * error;
    }
  }
  comparison.rms = std::sqrt(comparison.rms);
}

// By all processors: vertices know nothing of each other.
template <typename Source>
Light light_on(const std::vector<Mesh>& meshes, const Source& source) {
  const std::size_t worker_count = std::max(1u, std::thread::hardware_concurrency());
  Light light;
  for (const Mesh& mesh : meshes) {
    const std::size_t count = mesh.normals.size();
    auto& values = light.emplace_back(count);
    std::vector<std::jthread> workers;
    for (std::size_t worker = 0; worker < worker_count; ++worker) {
      workers.emplace_back(
          [&, begin = count * worker / worker_count, end = count * (worker + 1) / worker_count] {
            for (std::size_t i = begin; i < end; ++i)
              values[i] = source.irradiance(mesh.normals[i]);
          });
    }
  }
  return light;
}

// Pixels of another light would be no reference.
std::string why_no_reference(const SceneInput& input, const Pixels& pixels) {
  if (!current_panorama(input).change.is_whole) {
    return "its pixels are of another light: some was added or taken out";
  }
  return pixels.empty() ? input.pixels->why_empty(input.current) : "";
}

// Those that the quadratic form holds.
std::string coefficients_of_degree(int degree) {
  constexpr const char* kNumbers[] = {"one coefficient", "four coefficients", "nine coefficients"};
  return kNumbers[std::min(degree, 2)];
}

// Of a larger file the means are summed that its preview has.
std::string describe_texels(const Panorama& panorama, const Pixels& pixels) {
  const bool all = are_its_texels(panorama, pixels, kReferenceWidth);
  const std::string texels =
      all ? "every texel"
          : std::to_string(pixels.width) + " x " + std::to_string(pixels.height) + " texels";
  return panorama.change == LightChange{} ? texels : texels + ", changed as its light is";
}

using ColourOf = std::function<glm::vec3(std::size_t mesh, std::size_t vertex)>;

void add_exhibits(const std::vector<Mesh>& meshes, const ColourOf& colour_of, const Frame& frame,
                  SharedCamera& camera, Stage& stage, const Rectangle& area) {
  vtkRenderer& view = stage.add_view(area);
  camera.look(view, frame, kSceneRadius);
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    std::vector<glm::vec3> colours;
    for (std::size_t i = 0; i < meshes[mesh].positions.size(); ++i) {
      colours.push_back(colour_of(mesh, i));
    }
    add_mesh(view, meshes[mesh], colours, Shading::unlit);
  }
}

struct Column {
  std::string title;
  std::string subtitle;
  ColourOf colour_of;
};

void add_columns(const std::vector<Column>& columns, const std::vector<Mesh>& meshes,
                 const Frame& frame, Stage& stage, const Rectangle& area) {
  const double line = stage.line_height(TextSize::label);
  SharedCamera camera;  // one for all, so that they turn together
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Rectangle cell = part_of_row(area, stage.aspect(area), static_cast<int>(columns.size()),
                                       static_cast<int>(i));
    stage.add_text(cell.center_x(), cell.top - line, columns[i].title,
                   {.size = TextSize::heading, .align = TextAlign::center});
    stage.add_text(
        cell.center_x(), cell.top - 2.1 * line, columns[i].subtitle,
        {.colour = theme::kDimText, .align = TextAlign::center, .max_width = cell.width()});
    add_exhibits(meshes, columns[i].colour_of, frame, camera, stage,
                 {cell.left, cell.bottom, cell.right, cell.top - 2.5 * line});
  }
}

ColourOf as_seen(const Light& light, double exposure) {
  return [&light, exposure](std::size_t mesh, std::size_t i) {
    return tone_mapped(kAlbedo / std::numbers::pi * light[mesh][i], exposure);
  };
}

void show_alone(const std::vector<Mesh>& meshes, const Comparison& lit, double exposure,
                const Frame& frame, Stage& stage) {
  add_columns({{lit.form_is, "quadratic form of the normal", as_seen(lit.form, exposure)}}, meshes,
              frame, stage, stage.body());
}

ColourBar difference_bar(const Comparison& lit, double scale) {
  const bool has_mean = lit.mean > 0.0;
  const double ends = has_mean ? 100.0 * scale / lit.mean : scale;
  return {-ends, ends, has_mean ? "luminance, % of the mean" : "luminance",
          [](double fraction) { return diverging_colour(2.0 * fraction - 1.0); }};
}

// For the caption. Nothing is a part of a mean of zero.
std::string describe_error(const Comparison& lit) {
  const auto told = [&](double error) {
    return lit.mean > 0.0 ? percent_of(error / lit.mean) : text_of(error);
  };
  return "over all normals they are off by " + told(lit.rms) +
         (lit.mean > 0.0 ? " of the mean (RMS)" : " (RMS)") + ", at most by " + told(lit.largest);
}

void show_beside_reference(const std::vector<Mesh>& meshes, const Comparison& lit, double exposure,
                           const Frame& frame, Stage& stage) {
  const double end = std::max(lit.largest, kLeastScale * lit.mean);
  const double scale = end > 0.0 ? end : 1.0;
  const auto error = [&lit, scale](std::size_t mesh, std::size_t i) {
    return diverging_colour((luminance(lit.form[mesh][i]) - luminance(lit.reference[mesh][i])) /
                            scale);
  };
  const Rectangle body = stage.body();
  const double line = stage.line_height(TextSize::label);
  const Rectangle views{body.left, body.bottom + 3.6 * line, body.right, body.top};
  add_columns({{lit.form_is, "quadratic form of the normal", as_seen(lit.form, exposure)},
               {"reference", lit.reference_is, as_seen(lit.reference, exposure)},
               {"difference", lit.form_is + " minus reference", error}},
              meshes, frame, stage, views);
  const Rectangle last = part_of_row(views, stage.aspect(views), 3, 2);
  add_colour_bar(
      stage,
      {last.left + 0.03, body.bottom + 1.5 * line, last.right - 0.03, body.bottom + 2.3 * line},
      difference_bar(lit, scale));
}

}  // namespace

Status show_lit_scene(const SceneInput& input, Stage& stage) {
  const SceneSettings& settings = input.settings;
  const Panorama& panorama = current_panorama(input);
  const Coefficients radiance = radiance_of(panorama);
  const double exposure = automatic_exposure(radiance, settings.exposure_stops);
  const Pixels& pixels = input.pixels->get(input.current, kReferenceWidth, Lying::as_in_file);
  const std::string missing = why_no_reference(input, pixels);
  const std::vector<Mesh> meshes = exhibits(settings.frame);
  Comparison lit;
  lit.form_is = coefficients_of_degree(radiance.degree);
  lit.form = light_on(meshes, IrradianceForm(to_frame(radiance, settings.frame)));
  if (missing.empty()) {
    const glm::dmat3 to_drawn = native_to_frame(settings.frame) * panorama.change.turn;
    lit.reference = light_on(meshes, TexelLight(pixels, to_drawn));
    lit.reference_is = "integral over " + describe_texels(panorama, pixels);
    measure(meshes.front(), lit);
  }

  stage.set_title(title_of(panorama), "white things in its light");
  const std::string figures = missing.empty() ? describe_error(lit) : "no reference: " + missing;
  const std::string lines[] = {
      figures + "; irradiance on albedo 0.8, without shadows",
      "one exposure, " + text_of(std::log2(exposure)) + " stops; " + describe(settings.frame)};
  stage.set_caption(lines);
  if (missing.empty()) {
    show_beside_reference(meshes, lit, exposure, settings.frame, stage);
  } else {
    show_alone(meshes, lit, exposure, settings.frame, stage);
  }
  return {};
}

}  // namespace shoal::viz
