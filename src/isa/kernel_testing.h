// What kernel tests share: a scene's view without rendering it, made-up queues, and comparing them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/aligned.h"
#include "isa/probe_testing.h"
#include "norrsken/scene.h"
#include "render/scene_view.h"
#include "render/wave_arena.h"

namespace norrsken {

/// A scene and a view of it.
struct ViewedScene {
  Scene scene;
  Accel accel;
  SceneView view;

  ViewedScene(Scene s, AccelKind kind)
      : scene(std::move(s)),
        accel(scene.tables().tables, kind),
        view(make_scene_view(scene.tables().tables, accel.view())) {}
};

inline std::unique_ptr<ViewedScene> view_scene(const std::string& name, AccelKind kind,
                                               const LoadOptions& options = {}) {
  const Result<Scene> scene = Scene::load(name, options);
  for (const Diagnostic& d : scene.diagnostics().all()) ADD_FAILURE() << to_text(d);
  return scene ? std::make_unique<ViewedScene>(*scene, kind) : nullptr;
}

/// Every usable instruction set but the one-lane oracle.
inline std::vector<const KernelEntry*> wide_kernels() {
  std::vector<const KernelEntry*> kernels;
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    if ((*k)->lanes > 1) kernels.push_back(*k);
  }
  return kernels;
}

inline float float_of(std::uint32_t word) {
  float f;
  std::memcpy(&f, &word, sizeof f);
  return f;
}
inline std::uint32_t word_of(float f) {
  std::uint32_t word;
  std::memcpy(&word, &f, sizeof word);
  return word;
}

/// Fills everything behind a queue's end with values that would do harm if they were looked at.
template <class Record>
void poison_tail(Queue<Record>& q) {
  for (std::uint32_t k = 0; k < q.kFields; ++k) {
    for (std::uint32_t i = q.count; i < q.count + kMaxLanes; ++i) q.field(k)[i] = float_of(0x7fabcdefu);
  }
}

/// Rays from random points of a box in random directions.
class RandomRays {
 public:
  RandomRays(std::uint32_t count, unsigned seed, const double lower[3], const double upper[3]) : count_(count) {
    const std::size_t padded = (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
    values_.resize(6 * padded);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < padded; ++i) {
      double d[3], length = 0;
      for (double& x : d) x = normal(random), length += x * x;
      for (std::size_t k = 0; k < 3; ++k) {
        values_[k * padded + i] = static_cast<float>(lower[k] + (upper[k] - lower[k]) * unit(random));
        values_[(3 + k) * padded + i] = static_cast<float>(d[k] / std::sqrt(length));
      }
    }
    const float* v = values_.data();
    arrays_ = {v, v + padded, v + 2 * padded, v + 3 * padded, v + 4 * padded, v + 5 * padded, count};
  }
  const RayArrays& arrays() const { return arrays_; }

 private:
  std::uint32_t count_;
  AlignedVector<float> values_;
  RayArrays arrays_{};
};

/// Aligned memory for a ray kernel's answers.
template <class T>
class Answers {
 public:
  explicit Answers(std::uint32_t count) : values_((count + kMaxLanes) / kMaxLanes * kMaxLanes + kMaxLanes) {}
  T* data() { return values_.data(); }
  T operator[](std::uint32_t i) const { return values_[i]; }

 private:
  AlignedVector<T> values_;
};

}  // namespace norrsken
