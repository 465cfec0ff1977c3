// Warps against their densities, and the small functions they stand on.
#include "math/warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "math/frame.h"

namespace norrsken::isa_host {
namespace {

/// Points of a golden-ratio lattice: even over the square without rows that a warp would map onto rings.
constexpr int kPoints = 1 << 20;

/// Share of the square that lands in each of `cells` cells.
std::vector<double> histogram(int cells, const std::function<int(Vec2f)>& cell) {
  std::vector<double> shares(static_cast<std::size_t>(cells));
  for (int i = 0; i < kPoints; ++i) {
    const double x = (i + 0.5) / kPoints, y = std::fmod(i * 0.6180339887498949, 1.0);
    const int c = cell({static_cast<float>(x), static_cast<float>(y)});
    if (c >= 0 && c < cells) shares[static_cast<std::size_t>(c)] += 1.0 / kPoints;
  }
  return shares;
}

TEST(Warp, DiskPreservesArea) {
  constexpr int kBins = 16;
  const auto shares = histogram(kBins * kBins, [](Vec2f u) {
    const Vec2f d = warp_to_disk(u);
    const double r2 = double(d.x.v) * double(d.x.v) + double(d.y.v) * double(d.y.v);
    EXPECT_LE(r2, 1.0 + 1e-6);
    const double turn = std::atan2(double(d.y.v), double(d.x.v)) / (2 * M_PI) + 0.5;
    return std::min(int(r2 * kBins), kBins - 1) * kBins + std::min(int(turn * kBins), kBins - 1);
  });
  // Squared radius and angle are uniform over the disk.
  for (const double s : shares) EXPECT_NEAR(s * kBins * kBins, 1.0, 0.03);
}

TEST(Warp, CosineHemisphereFollowsItsDensity) {
  constexpr int kBins = 20;
  const auto shares = histogram(kBins, [](Vec2f u) {
    const Vec3f w = warp_to_cosine_hemisphere(u);
    EXPECT_NEAR(double(dot(w, w).v), 1.0, 1e-5);
    return std::min(int(double(w.z.v) * kBins), kBins - 1);
  });
  for (int b = 0; b < kBins; ++b) {
    // Integral of cos/pi over the zone cos in [b, b+1)/kBins: the pdf over solid angle 2 pi d(cos).
    double wanted = 0;
    for (int i = 0; i < 100; ++i) {
      const double z = (b + (i + 0.5) / 100) / kBins;
      wanted += double(cosine_hemisphere_pdf_sa(Float(float(z))).v) * 2 * M_PI / (kBins * 100);
    }
    EXPECT_NEAR(shares[std::size_t(b)], wanted, 2e-3);
  }
}

TEST(Warp, TriangleIsUniform) {
  constexpr int kBins = 8;
  const auto shares = histogram(kBins * kBins, [](Vec2f u) {
    const Vec2f b = warp_to_triangle(u);
    EXPECT_GE(double(b.x.v), 0.0);
    EXPECT_GE(double(b.y.v), 0.0);
    EXPECT_LE(double(b.x.v) + double(b.y.v), 1.0 + 1e-6);
    return std::min(int(double(b.x.v) * kBins), kBins - 1) * kBins + std::min(int(double(b.y.v) * kBins), kBins - 1);
  });
  for (int i = 0; i < kBins; ++i) {
    for (int k = 0; k < kBins; ++k) {
      const double share = shares[std::size_t(i * kBins + k)] * kBins * kBins;
      const double wanted = i + k < kBins - 1 ? 2.0 : i + k == kBins - 1 ? 1.0 : 0.0;
      EXPECT_NEAR(share, wanted, 0.05) << i << " " << k;
    }
  }
}

TEST(Warp, ConeIsUniformOverItsSolidAngle) {
  for (const float h : {1e-6f, 0.01f, 0.5f, 1.0f}) {
    constexpr int kBins = 16;
    const auto shares = histogram(kBins * kBins, [&](Vec2f u) {
      const Vec3f w = warp_to_cone(u, Float(h));
      const double sin2 = double(w.x.v) * double(w.x.v) + double(w.y.v) * double(w.y.v);
      const double height = sin2 / (1 + std::sqrt(std::max(0.0, 1 - sin2)));  // 1 - cos, without cancellation
      const double turn = std::atan2(double(w.y.v), double(w.x.v)) / (2 * M_PI) + 0.5;
      return std::min(int(height / double(h) * kBins), kBins - 1) * kBins + std::min(int(turn * kBins), kBins - 1);
    });
    for (const double s : shares) EXPECT_NEAR(s * kBins * kBins, 1.0, 0.05) << h;
    EXPECT_NEAR(double(cone_pdf_sa(Float(h)).v) * 2 * M_PI * double(h), 1.0, 1e-5);
  }
}

TEST(Trig, SinCosOfTurns) {
  for (int i = 0; i <= 100'000; ++i) {
    const float u = static_cast<float>(i) / 100'000;
    const SinCos q = sin_cos_turns(Float(u));
    ASSERT_NEAR(double(q.sin.v), std::sin(2 * M_PI * double(u)), 4e-7) << u;
    ASSERT_NEAR(double(q.cos.v), std::cos(2 * M_PI * double(u)), 4e-7) << u;
  }
}

TEST(Frame, IsOrthonormalAroundEveryNormal) {
  for (int i = -20; i <= 20; ++i) {
    for (int k = 0; k < 40; ++k) {
      const double z = i / 20.0, r = std::sqrt(1 - z * z), phi = k * M_PI / 20;
      const Vec3f n{float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)};
      const Frame f = make_frame(n);
      EXPECT_NEAR(double(dot(f.s, f.s).v), 1, 1e-5);
      EXPECT_NEAR(double(dot(f.t, f.t).v), 1, 1e-5);
      EXPECT_NEAR(double(dot(f.s, f.t).v), 0, 1e-5);
      EXPECT_NEAR(double(dot(f.s, n).v), 0, 1e-5);
      EXPECT_NEAR(double(dot(f.t, n).v), 0, 1e-5);
      const Vec3f right = cross(f.s, f.t);
      EXPECT_NEAR(double(dot(right, n).v), 1, 1e-5);
      const Vec3f w{Float(0.36f), Float(0.48f), Float(-0.8f)}, back = f.to_world(f.to_local(w));
      EXPECT_NEAR(double(dot(back, w).v), 1, 1e-5);
    }
  }
}

}  // namespace
}  // namespace norrsken::isa_host
