// SPDX-License-Identifier: BSL-1.0
/// @file
/// The simulator, namespace gnomon::simulation: scenes, range finders, and scans with ground truth.
/// It is not part of gnomon.hpp: tests, benchmarks and training need it, and it would lengthen
/// every other compilation.
#pragma once

#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/box_and_cylinder.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/chair.hpp>
#include <gnomon/simulation/clutter.hpp>
#include <gnomon/simulation/cone.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/depth_camera.hpp>
#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/kinematic_chain.hpp>
#include <gnomon/simulation/object_views.hpp>
#include <gnomon/simulation/office_chairs.hpp>
#include <gnomon/simulation/office_tables.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/ray_caster.hpp>
#include <gnomon/simulation/sample_surface.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/shape.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/sphere.hpp>
#include <gnomon/simulation/spinning_lidar.hpp>
#include <gnomon/simulation/street.hpp>
#include <gnomon/simulation/surface_of_revolution.hpp>
#include <gnomon/simulation/table.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>
#include <gnomon/simulation/trajectory.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>
#include <gnomon/simulation/true_scan.hpp>
#include <gnomon/simulation/vehicle.hpp>
