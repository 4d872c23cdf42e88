// SPDX-License-Identifier: BSD-3-Clause
#include "scene/surface_rays.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#if INSONIFY_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3f;

constexpr float near_radii = 3;      // distance within which a back belongs to the surface that the ray leaves
constexpr float noise_widths = 3;    // distance from a surfel's plane within which a ray starts on its surface
constexpr float cluster_radii = 2;   // extent along the ray of one hit of one surface
constexpr float cluster_height = 1;  // extent across the surface, in radii
constexpr float like_normals = 0.7f;
constexpr float kernel = 0.6f;  // radius over the root of the area: as small as the scatter of the density allows

#if INSONIFY_EMBREE >= 4
using RayContext = RTCRayQueryContext;
constexpr RTCSceneFlags filter_of_rays = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using RayContext = RTCIntersectContext;
constexpr RTCSceneFlags filter_of_rays = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

/// A ray under way, as Embree hands it to the filter.
struct Query {
  RayContext context;  // first, so that its address is that of the query
  const SceneCloud& scene;
  float footprint;
  const SurfaceRay& ray;
  /// The first surface that is met. Surfels met beside it are added up. nullptr: not yet found.
  struct Position {
    Vector3f at, normal;
    float radius;
    std::uint32_t nearest;
    float squared_distance;
    int surfels;
  }* position = nullptr;

  float radius(std::uint32_t j) const { return footprint * std::sqrt(scene.area[j]); }
  float noise(std::uint32_t j) const { return scene.noise.empty() ? 0 : scene.noise[j]; }

  /// Returns true if surfel j at `distance` belongs to the surface that the ray leaves.
  bool passes(std::uint32_t j, float distance) const {
    if (j == ray.surfel) return true;
    float height = scene.normal[j].dot(ray.from - scene.point[j]);
    if (!scene.normals_oriented) height = std::abs(height);
    if (height <= 0 && distance < near_radii * radius(j)) return true;
    return std::abs(height) <= noise_widths * (noise(j) + noise(ray.surfel));
  }
  /// Adds surfel j, met at `distance`, if it belongs to the surface.
  void add(std::uint32_t j, float distance) const {
    const Vector3f at = ray.from + distance * ray.direction;
    float alike = scene.normal[j].dot(position->normal);
    if (!scene.normals_oriented) alike = std::abs(alike);
    if (alike < like_normals || std::abs((at - position->at).dot(position->normal)) > cluster_height * position->radius)
      return;
    if ((at - scene.point[j]).squaredNorm() <= kernel * kernel * scene.area[j]) ++position->surfels;
    const float squared = (scene.point[j] - position->at).squaredNorm();
    if (squared > position->squared_distance || (squared == position->squared_distance && j > position->nearest))
      return;
    position->nearest = j, position->squared_distance = squared;
  }

  /// Accepts or rejects the disc that a ray has met, for Embree.
  static void filter(const RTCFilterFunctionNArguments* met) {
    if (met->valid[0] != -1) return;
    const auto& query = *reinterpret_cast<const Query*>(met->context);
    const std::uint32_t surfel = RTCHitN_primID(met->hit, met->N, 0);
    const float distance = RTCRayN_tfar(met->ray, met->N, 0);
    const bool passes = query.passes(surfel, distance);
    if (query.position && !passes) query.add(surfel, distance);
    if (query.position || passes) met->valid[0] = 0;
  }

  /// Traces a ray through the discs; the filter sees each of them.
  void send(RTCScene discs, RTCRayHit& along) {
#if INSONIFY_EMBREE >= 4
    rtcInitRayQueryContext(&context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    arguments.context = &context, arguments.filter = filter;
    rtcIntersect1(discs, &along, &arguments);
#else
    rtcInitIntersectContext(&context);
    context.filter = filter;
    rtcIntersect1(discs, &context, &along);
#endif
  }
};

RTCRayHit ray_within(const SurfaceRay& ray, float from, float to) {
  RTCRayHit result{};
  result.ray.org_x = ray.from.x(), result.ray.org_y = ray.from.y(), result.ray.org_z = ray.from.z();
  result.ray.dir_x = ray.direction.x(), result.ray.dir_y = ray.direction.y(), result.ray.dir_z = ray.direction.z();
  result.ray.tnear = from, result.ray.tfar = to;
  result.ray.mask = 0xffffffffu;
  result.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return result;
}

}  // namespace

struct SurfaceRays::Tree {
  const SceneCloud& scene;
  float footprint;
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device{rtcNewDevice(nullptr), rtcReleaseDevice};
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> discs{nullptr, rtcReleaseScene};

  Tree(const SceneCloud& of, double disc) : scene(of), footprint(static_cast<float>(disc)) {
    require_no_error();
    discs.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(discs.get(), filter_of_rays);
    const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                                4 * sizeof(float), scene.size()));
    auto* normals = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), scene.size()));
    require_no_error();
    for (std::size_t i = 0; i < scene.size(); ++i) {
      std::copy_n(scene.point[i].data(), 3, corners + 4 * i);
      corners[4 * i + 3] = footprint * std::sqrt(scene.area[i]);
      std::copy_n(scene.normal[i].data(), 3, normals + 3 * i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(discs.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(discs.get());
    require_no_error();
  }

  void require_no_error() const {
    const RTCError error = rtcGetDeviceError(device.get());
    if (error != RTC_ERROR_NONE)
      fail(ErrorKind::runtime, "SurfaceRays: Embree cannot build a tree over ", scene.size(), " surfels (",
           error == RTC_ERROR_OUT_OF_MEMORY ? "memory is short; thin the scene" : "error of its own", ")");
  }
};

bool SurfaceRays::available() { return true; }

SurfaceRays::SurfaceRays(const SceneCloud& scene, double footprint)
    : tree_(std::make_shared<const Tree>(scene, footprint)) {}

SurfaceRayEnd SurfaceRays::first_hit(const SurfaceRay& ray) const {
  const SceneCloud& scene = tree_->scene;
  Query query{{}, scene, tree_->footprint, ray};

  // Find the nearest disc.
  RTCRayHit first = ray_within(ray, 0, std::numeric_limits<float>::infinity());
  query.send(tree_->discs.get(), first);
  if (first.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const std::uint32_t met = first.hit.primID;
  const float distance = first.ray.tfar;
  if (scene.normals_oriented && scene.normal[met].dot(ray.direction) >= 0) return {};

  // Add up all discs of that surface along the ray.
  Query::Position position{ray.from + distance * ray.direction,
                           scene.normal[met],
                           query.radius(met),
                           met,
                           std::numeric_limits<float>::infinity(),
                           0};
  query.position = &position;
  RTCRayHit beside = ray_within(ray, std::max(0.0f, distance - cluster_radii * position.radius),
                                distance + cluster_radii * position.radius);
  query.send(tree_->discs.get(), beside);
  const float share = 1 / (static_cast<float>(pi) * kernel * kernel);                 // kernel area covered by a surfel
  return {position.nearest, distance, static_cast<float>(position.surfels) * share};  // (E159)
}

}  // namespace insonify
