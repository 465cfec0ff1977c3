#include "tests/closed_form/plane_scene.h"

#include "tests/closed_form/closed_form.h"

namespace norrsken::closed_form {

namespace {

constexpr Vec kUp{0, 0, 1};

/// Mean of the radiance `radiance_at(point)` over each pixel's square on the plane. The midpoint rule's error is of
/// order (pixel / steps)^2, under 1e-6 here.
template <typename RadianceAt>
statistics::Picture average(int width, int height, RadianceAt radiance_at) {
  constexpr int kSteps = 16;
  const oracle::Camera& camera = PlaneScene::kCamera;  // its film lies on the plane
  statistics::Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      oracle::Rgb sum;
      for (int j = 0; j < kSteps; ++j) {
        for (int i = 0; i < kSteps; ++i) {
          sum += radiance_at(camera.top_left + (x + (i + 0.5) / kSteps) / width * camera.across +
                             (y + (j + 0.5) / kSteps) / height * camera.down);
        }
      }
      const oracle::Rgb mean = sum / (kSteps * kSteps);
      picture.at(x, y) = {mean.x, mean.y, mean.z};
    }
  }
  return picture;
}

}  // namespace

statistics::Picture PlaneScene::image(Light light, int width, int height) {
  const auto shines = [light](Light which) { return light == which || light == Light::all; };
  return average(width, height, [&](const oracle::Vec& point) {
    oracle::Rgb irradiance;
    if (shines(Light::point)) irradiance += kPoint.intensity * point_light_irradiance(1, kPoint.position, point, kUp);
    if (shines(Light::rectangle)) irradiance += kRectangleRadiance * polygon_irradiance(1, kRectangle, point, kUp);
    if (shines(Light::triangle)) irradiance += kTriangleRadiance * polygon_irradiance(1, kTriangle, point, kUp);
    if (shines(Light::sphere)) {
      irradiance += kSphereRadiance * sphere_irradiance(1, kSphereCentre, kSphereRadius, point, kUp);
    }
    return kAlbedo * irradiance * reflected_radiance(1, 1);
  });
}

}  // namespace norrsken::closed_form
