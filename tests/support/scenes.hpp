// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Adds a sphere of `count` surfels on a Fibonacci spiral, each with 1/count of the area; side = -1: normals inward.
void add_sphere(SceneCloud& scene, const Eigen::Vector3d& centre, double radius, int count, double side = 1);

/// Adds a rectangle with one surfel per cell of about `spacing`, moved from its centre by up to `jitter` cells.
void add_rectangle(SceneCloud& scene, const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                   const Eigen::Vector3d& normal, double spacing, double jitter = 0);

/// Adds a level square of side x side surfels, normals up, whose first corner is at `corner`.
void add_floor(SceneCloud& scene, const Eigen::Vector3d& corner, int side, double spacing);

/// Returns a square plate of n x n surfels about (x, 0, 0), across the x axis whatever the normal.
SceneCloud plate(double x, double size, int n, const Eigen::Vector3d& normal = {-1, 0, 0});

SceneCloud harbour(std::size_t points = 60000);

double total_area(const SceneCloud& scene);
Eigen::Vector3d world(const SceneCloud& scene, std::size_t i);

/// Expects all arrays but the points to be equal to the bit.
void expect_same_attributes(const SceneCloud& a, const SceneCloud& b);
void expect_same_surfels(const SceneCloud& a, const SceneCloud& b);

}  // namespace insonify
