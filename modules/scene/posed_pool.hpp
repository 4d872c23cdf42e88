// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "scene/posed_scene.hpp"

namespace insonify {

/// Posed scenes for several threads. Each is in use for one key at a time; one that is released is posed anew.
template <typename Key>
class PosedPool {
 public:
  /// Makes a scene.
  using Make = std::function<std::unique_ptr<PosedScene>()>;
  /// Poses a scene.
  using Pose = std::function<std::shared_ptr<const PreparedScene>(PosedScene&)>;

  /// Keeps how a scene is made when all are in use.
  explicit PosedPool(Make make) : make_(std::move(make)), all_(std::make_shared<All>()) {}
  /// Makes the first scene now.
  void prepare() { all_->idle.push_back(make_()); }

  /// Returns the scene of a key: one that is in use for it, else one that `pose` poses, for which others that ask for the
  /// key wait. Any thread may release it.
  std::shared_ptr<const PreparedScene> scene_of(const Key& key, const Pose& pose) const {
    const std::shared_ptr<Use> use = use_of(key);
    const std::scoped_lock lock(use->guard);
    if (std::shared_ptr<const PreparedScene> there = use->scene.lock()) return there;
    const auto loan = std::make_shared<Loan>(all_, take());
    loan->scene = pose(*loan->posed);
    std::shared_ptr<const PreparedScene> scene(loan, loan->scene.get());
    use->scene = scene;
    return scene;
  }

 private:
  /// The use of a scene for a key.
  struct Use {
    Key key;
    std::mutex guard{};
    std::weak_ptr<const PreparedScene> scene{};
  };
  struct All {
    std::mutex guard;
    std::vector<std::unique_ptr<PosedScene>> idle;
    std::vector<std::shared_ptr<Use>> uses;
  };
  /// A scene in use. It goes back to the idle ones when its last owner releases it.
  struct Loan {
    std::shared_ptr<All> all;
    std::unique_ptr<PosedScene> posed;
    std::shared_ptr<const PreparedScene> scene{};

    Loan(std::shared_ptr<All> of, std::unique_ptr<PosedScene> taken) : all(std::move(of)), posed(std::move(taken)) {}
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    ~Loan() {
      scene.reset();
      const std::scoped_lock lock(all->guard);
      all->idle.push_back(std::move(posed));
    }
  };
  std::shared_ptr<Use> use_of(const Key& key) const {
    const std::scoped_lock lock(all_->guard);
    std::erase_if(all_->uses, [](const auto& use) { return use.use_count() == 1 && use->scene.expired(); });
    for (const std::shared_ptr<Use>& use : all_->uses)
      if (use->key == key) return use;
    return all_->uses.emplace_back(std::shared_ptr<Use>(new Use{key}));
  }
  std::unique_ptr<PosedScene> take() const {
    {
      const std::scoped_lock lock(all_->guard);
      if (!all_->idle.empty()) {
        std::unique_ptr<PosedScene> scene = std::move(all_->idle.back());
        all_->idle.pop_back();
        return scene;
      }
    }
    return make_();
  }

  Make make_;
  std::shared_ptr<All> all_;  ///< shared with the scenes in use
};

}  // namespace insonify
