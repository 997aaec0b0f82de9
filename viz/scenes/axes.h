// What tells directions and sizes around a lobe.
//
// VTK's world is right-handed, and a frame's x, y and z are drawn along the world's. A frame is
// only a way to name directions by three numbers, so this is true for the tool whose frame it is:
// where its x, y and z are right-handed too, the picture shows what stands around its camera; where
// the frame does not mirror (sphere/frame.h), the tool sees the panorama left-right exchanged, and
// so does this picture.
#pragma once

#include <vtkRenderer.h>

#include <memory>

#include "scenes/mesh.h"
#include "scenes/stage.h"
#include "sphere/frame.h"

namespace shoal::viz {

// The three axes through the origin, arrows at their positive ends, labelled "+x", "-x" ... where
// the mesh, if any, does not stand before the label.
void add_axes(Stage& stage, vtkRenderer& view, double length, TextSize size = TextSize::label,
              const std::shared_ptr<const Mesh>& hidden_by = nullptr);

// The same without words and negative halves, for small views.
void add_small_axes(vtkRenderer& view, double length);

// Meridians and parallels of a sphere around the frame's up axis, every 30 degrees, its equator
// brighter.
void add_scale_sphere(vtkRenderer& view, const Frame& frame, double radius = 1.0);

// "frame vtk, three, gltf: centre +x, right +z, up +y"; every tool whose frame it is, and whether
// they see a mirror image of the scene.
[[nodiscard]] std::string describe(const Frame& frame);

}  // namespace shoal::viz
