// SPDX-License-Identifier: BSD-3-Clause
#include "survey/scene_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/random.hpp"

namespace insonify {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr std::uint64_t most_tries = 4000;  // positions tried for one body
constexpr std::size_t kept_draws = 8;

void require_area(const SceneBody& body) {
  double area = 0;
  if (body.cloud)
    for (const float a : body.cloud->area) area += a;
  if (!(area > 0)) fail(ErrorKind::content, "part '", body.name, "' has no area: its surfels hear nothing");
}

/// Returns a body of this scale, without a pose; `cloud` has that scale already.
PlacedPart with_scale(const SceneBody& body, double scale, std::shared_ptr<const SceneCloud> cloud) {
  PlacedPart part{body.name, body.label, std::move(cloud)};
  part.file_origin = -scale * body.centre, part.scale = scale, part.size = scale * body.size;
  return part;
}

/// Returns a body whose file has these axes. Its own axes have their origin elsewhere, and move as the body turns.
PlacedPart placed_at(const SceneBody& body, const MovingAxes& axes, double scale,
                     std::shared_ptr<const SceneCloud> cloud) {
  PlacedPart part = with_scale(body, scale, std::move(cloud));
  const Vector3d arm = axes.pose.linear() * (scale * body.centre);
  part.world_from_part = Eigen::Translation3d(arm) * axes.pose;
  part.velocity = axes.motion.velocity + axes.motion.turn_rate.cross(arm);
  part.turn_rate = axes.motion.turn_rate;
  return part;
}

/// The random numbers of one draw of scattered bodies.
struct Draws {
  std::uint64_t seed, scatter, draw;

  std::array<double, 4> of(std::uint64_t body, std::uint64_t number) const {
    return random_uniform(seed, RandomStage::scene_draw, {scatter, draw, body << 32 | number});
  }
};

std::size_t whole(double u, std::size_t below) { return static_cast<std::size_t>(u * static_cast<double>(below)); }
double between(double u, double least, double most) { return least + u * (most - least); }
double within(double u, double half) { return (2 * u - 1) * half; }

/// The disc that a placed body takes.
struct Taken {
  Vector2d centre;
  double radius;
};

/// A body that has its attitude but no position yet.
struct Hovering {
  PlacedPart part;
  double radius, bury;  // [m]
};

/// A body that has come to rest; without a part if it is wholly below the ground.
struct Setting {
  bool found = false;
  std::optional<PlacedPart> part;
};

/// Tries positions until one is free and has ground, and adds that one to `taken`.
Setting set_down(const Draws& draws, std::uint64_t number, const ScatterRule& rule, Hovering body, const Ground& ground,
                 std::vector<Taken>& taken) {
  Vector2d low = rule.area.front(), high = low;
  for (const Vector2d& corner : rule.area) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  for (std::uint64_t t = 0; t < most_tries; ++t) {
    const auto u = draws.of(number, 2 + t);
    const Vector2d position(between(u[0], low.x(), high.x()), between(u[1], low.y(), high.y()));
    const auto is_near = [&](const Taken& other) {
      return (position - other.centre).norm() < rule.min_distance.value_or(body.radius + other.radius);
    };
    if (!is_within(rule.area, position) || std::ranges::any_of(taken, is_near) || !ground.at(position)) continue;
    body.part.world_from_part.translation() << position, 0;
    try {
      Setting setting{true, place_on_ground(body.part, ground, rule.rest, body.bury)};
      taken.push_back({position, body.radius});
      return setting;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::content) throw;  // the body is beside a hole: try the next
    }
  }
  return {};
}

}  // namespace

SceneParts::SceneParts(std::vector<PartDefinition> parts, std::vector<SceneScatter> scatters, std::uint64_t seed,
                       bool drawn_anew)
    : seed_(seed), drawn_anew_(drawn_anew && !scatters.empty()) {
  number_classes(parts, scatters);
  for (PartDefinition& part : parts) {
    names_.push_back(part.body.name);
    put(part);
  }
  for (const SceneScatter& scatter : scatters) prepare_scatter(scatter);
  std::set<std::string> unique;
  for (const std::string& name : names_)
    if (!unique.insert(name).second)
      fail(ErrorKind::content, "two parts are called '", name, "'; give one of them another name");
  if (!drawn_anew_)
    for (PlacedPart& part : drawn(0))
      if (!part.absent) resting_.push_back(std::move(part));
  if (!drawn_anew_) ground_ = {};
}

void SceneParts::number_classes(const std::vector<PartDefinition>& parts, const std::vector<SceneScatter>& scatters) {
  std::vector<const SceneBody*> bodies;
  for (const PartDefinition& part : parts) bodies.push_back(&part.body);
  for (const SceneScatter& scatter : scatters)
    for (const SceneBody& body : scatter.bodies) bodies.push_back(&body);
  std::vector<Material> all;
  for (const SceneBody* body : bodies)
    if (body->cloud) all.insert(all.end(), body->cloud->materials.begin(), body->cloud->materials.end());
  const auto add = [this](const Material& material) {
    if (std::ranges::find(materials_, material) == materials_.end()) materials_.push_back(material);
  };
  // Number the classes first: labels, and the materials of bodies without a label.
  for (const SceneBody* body : bodies) {
    if (!body->label.empty()) {
      const auto real = std::ranges::find(all, body->label, &Material::name);
      add(real != all.end() ? *real : Material{.name = body->label});
    } else if (body->cloud) {
      std::ranges::for_each(body->cloud->materials, add);
    }
  }
  std::ranges::for_each(all, add);
}

void SceneParts::put(const PartDefinition& part) {
  const SceneBody& body = part.body;
  require_area(body);
  const PartPlacement& p = part.placement;
  if (p.captured) {
    PlacedPart captured{body.name, body.label, body.cloud, true};
    ground_.add(captured);
    resting_.push_back(std::move(captured));
    return;
  }
  // Take the begin of the trajectory if there is one, else time 0.
  const double begin = p.trajectory ? p.trajectory->time.front() : 0;
  PlacedPart placed = placed_at(body, axes_at(p, body.name, begin), p.scale, scaled(body.cloud, p.scale));
  std::optional<PlacedPart> rests = place_on_ground(placed, ground_, p.rest, p.bury);
  if (p.moves()) {
    if (!rests) fail(ErrorKind::content, "part '", body.name, "' moves, but is wholly below the ground; bury it less");
    placed.world_from_part = rests->world_from_part;
    moving_.emplace_back(part, std::move(placed));
    return;
  }
  if (!rests) return;
  ground_.add(*rests);
  resting_.push_back(std::move(*rests));
}

void SceneParts::prepare_scatter(const SceneScatter& scatter) {
  require_valid(scatter.rule, "scatter");
  if (scatter.bodies.empty()) fail(ErrorKind::argument, "scatter: has no bodies, must have one at least");
  const Bounds& bed = ground_.captured_box();
  if (!(bed.min.x() <= bed.max.x()))
    fail(ErrorKind::content, "scatter of '", scatter.bodies.front().name,
         "': there is nothing to rest on: the scene has no captured part, a [[part]] without position_m");
  for (const Vector2d& corner : scatter.rule.area)
    if (!((corner.array() >= bed.min.head<2>().array()).all() && (corner.array() <= bed.max.head<2>().array()).all()))
      fail(ErrorKind::content, "scatter of '", scatter.bodies.front().name, "': corner (", corner.x(), ", ", corner.y(),
           ") of area_m is outside the bed, which reaches from (", bed.min.x(), ", ", bed.min.y(), ") to (",
           bed.max.x(), ", ", bed.max.y(), ") m");
  ScatteredBodies scattered{{}, scatter.rule};
  std::set<std::string> own;
  for (const SceneBody& body : scatter.bodies) {
    require_area(body);
    Drawable next{body};
    for (const ScatteredBodies& before : scattered_)
      for (const Drawable& other : before.bodies)
        if (other.body.name == body.name)
          next.numbers_from = std::max(next.numbers_from, other.numbers_from + before.rule.most);
    for (const Eigen::Vector3f& point : body.cloud->point)
      next.radius = std::max(next.radius, (body.cloud->origin + point.cast<double>()).norm());
    if (own.insert(body.name).second)
      for (int k = 1; k <= scatter.rule.most; ++k)
        names_.push_back(body.name + "-" + std::to_string(next.numbers_from + k));
    scattered.bodies.push_back(std::move(next));
  }
  scattered_.push_back(std::move(scattered));
}

std::vector<PlacedPart> SceneParts::drawn_of(std::size_t scatter, std::uint64_t draw) const {
  const auto& [bodies, rule] = scattered_[scatter];
  const Draws draws{seed_, scatter, draw};
  const auto how_many = draws.of(0, 0);
  const std::size_t drawn_count =
      static_cast<std::size_t>(rule.least) + whole(how_many[0], static_cast<std::size_t>(rule.most - rule.least) + 1);
  const std::size_t count = how_many[1] < rule.empty_share ? 0 : drawn_count;
  std::vector<Taken> taken;
  for (const PlacedPart& part : resting_)
    if (!part.captured) taken.push_back({part.world_from_part.translation().head<2>(), footprint_radius(part)});
  std::vector<PlacedPart> parts;
  std::map<std::string, int> so_far;
  for (std::uint64_t k = 1; k <= count; ++k) {
    // Draw the body and its attitude, which do not depend on its position.
    const auto what = draws.of(k, 0), turn = draws.of(k, 1);
    const Drawable& body = bodies[whole(what[0], bodies.size())];
    const double scale = between(what[1], rule.least_scale, rule.most_scale);
    PlacedPart part = with_scale(body.body, scale, scaled(body.body.cloud, scale));
    part.name += "-" + std::to_string(body.numbers_from + ++so_far[body.body.name]);
    part.world_from_part = pose_from_yaw_pitch_roll(Vector3d::Zero(), within(turn[0], rule.yaw),
                                                    within(turn[1], rule.tilt), within(turn[2], rule.tilt));
    const double bury = between(what[2], rule.least_bury, rule.most_bury) * height_of(part);
    const Setting setting = set_down(draws, k, rule, {std::move(part), body.radius * scale, bury}, ground_, taken);
    if (!setting.found)
      fail(ErrorKind::content, "scatter of ",
           shortened_list(bodies, ", ", [](const Drawable& d) { return "'" + d.body.name + "'"; }),
           ": no place for body ", k, " of ", count, " after ", most_tries,
           " tries; ask for fewer (count), a smaller min_distance_m, or a larger area_m without holes of the scan");
    if (setting.part) parts.push_back(*setting.part);
  }
  add_absent(scattered_[scatter], parts);
  return parts;
}

void SceneParts::add_absent(const ScatteredBodies& scattered, std::vector<PlacedPart>& parts) {
  std::set<std::string> there, listed;
  for (const PlacedPart& part : parts) there.insert(part.name);
  for (const Drawable& body : scattered.bodies)
    for (int k = 1; k <= scattered.rule.most; ++k) {
      const std::string name = body.body.name + "-" + std::to_string(body.numbers_from + k);
      if (there.contains(name) || !listed.insert(name).second) continue;
      PlacedPart& absent = parts.emplace_back();
      absent.name = name, absent.label = body.body.label, absent.absent = true;
    }
}

std::vector<PlacedPart> SceneParts::drawn(std::uint64_t draw) const {
  std::vector<PlacedPart> all;
  for (std::size_t s = 0; s < scattered_.size(); ++s)
    for (PlacedPart& part : drawn_of(s, draw)) all.push_back(std::move(part));
  return all;
}

std::vector<PlacedPart> SceneParts::others_at(double time, std::uint64_t draw) const {
  std::vector<PlacedPart> others;
  for (const auto& [part, at_begin] : moving_) {
    const PartPlacement& p = part.placement;
    PlacedPart now = placed_at(part.body, axes_at(p, part.body.name, time), p.scale, at_begin.cloud);
    if (p.rest != PartRest::none) {
      // The part was tilted and lowered at time 0. It moves on as a rigid body about the origin of its axes.
      const Pose free_at_begin = placed_at(part.body, axes_at(p, part.body.name, 0), p.scale, nullptr).world_from_part;
      const Vector3d shift = at_begin.world_from_part.translation() - free_at_begin.translation();
      const Eigen::Matrix3d turn = now.world_from_part.linear() * free_at_begin.linear().transpose();
      now.world_from_part.linear() = turn * at_begin.world_from_part.linear();
      now.world_from_part.translation() += shift;
    }
    others.push_back(std::move(now));
  }
  if (!drawn_anew_) return others;
  std::shared_ptr<const std::vector<PlacedPart>> kept;
  {
    const std::scoped_lock lock(guard_);
    for (const auto& [number, parts] : kept_draws_)
      if (number == draw) kept = parts;
  }
  if (!kept) {
    kept = std::make_shared<const std::vector<PlacedPart>>(drawn(draw));
    const std::scoped_lock lock(guard_);
    if (kept_draws_.size() >= kept_draws) kept_draws_.erase(kept_draws_.begin());
    kept_draws_.emplace_back(draw, kept);
  }
  others.insert(others.end(), kept->begin(), kept->end());
  return others;
}

double SceneParts::begin() const {
  double begin = 0;
  for (const auto& [part, at_begin] : moving_)
    if (const auto& t = part.placement.trajectory; t && !(t->time.front() <= 0 && t->time.back() >= 0))
      begin = std::max(begin, t->time.front());
  return begin;
}

void SceneParts::require_times(double first, double last) const {
  for (const auto& [part, at_begin] : moving_)
    for (const double time : {first, last}) axes_at(part.placement, part.body.name, time);
}

}  // namespace insonify
