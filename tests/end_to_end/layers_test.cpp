// What aov, depth and moment show, against closed forms.
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/closed_form/closed_form.h"
#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

using closed_form::Vec;

constexpr int kSize = 24;
const View kAbove;

std::string aov(const std::string& aovs, const std::string& nested = {}) {
  return "<integrator type=\"aov\">" + text("aovs", aovs) + nested + "</integrator>";
}
const std::string kLight = R"(<emitter type="constant"/>)";

/// A plane through (0, 0, 0.5) with this normal, the rectangle of half sides 3 and 1.5 turned by 30 degrees about y.
const std::string kTilted = R"(<shape type="rectangle"><transform name="to_world"><scale x="3" y="1.5"/>
  <rotate y="1" angle="30"/><translate z="0.5"/></transform>)" +
                            diffuse("0.2, 0.5, 0.8");
const Vec kAlongU{std::sqrt(0.75), 0, -0.5}, kNormal{0.5, 0, std::sqrt(0.75)};

class Layers : public SceneFolder {
 protected:
  Image render(const std::string& elements, RenderOptions options) const {
    options.threads = kThreads;
    return render_image(load_elements(elements), options);
  }
};

/// A pixel's values of the channels NAME.X, NAME.Y, NAME.Z or others.
struct Reader {
  const Image& image;

  double operator()(const std::string& channel, std::size_t pixel) const {
    const Channel* found = image.find(channel);
    if (found == nullptr) throw std::runtime_error("no channel " + channel);
    return static_cast<double>(found->values[pixel]);
  }
  Vec vec(const std::string& name, std::size_t pixel) const {
    return {(*this)(name + ".X", pixel), (*this)(name + ".Y", pixel), (*this)(name + ".Z", pixel)};
  }
};

void expect_vec(const Vec& got, const Vec& wanted, double tolerance, const std::string& what) {
  EXPECT_NEAR(got.x, wanted.x, tolerance) << what;
  EXPECT_NEAR(got.y, wanted.y, tolerance) << what;
  EXPECT_NEAR(got.z, wanted.z, tolerance) << what;
}

/// Of one sample per pixel, all layers tell of the same point, which is in its pixel.
TEST_F(Layers, OfOneSampleFitTogether) {
  const Image image =
      render(aov("p:position,d:depth,t:uv,g:geo_normal,n:sh_normal,pu:dp_du,pv:dp_dv,a:albedo,s:shape_index",
                 R"(<integrator type="depth" name="dist"/>)") +
                 camera(kSize) + R"(<shape type="sphere"><point name="center" value="0, 9, 0"/></shape>)" + kTilted +
                 "</shape>" + kLight,
             {.samples_per_pixel = 1});
  const Reader read{image};
  const Vec origin{0, 0, 4};
  int hits = 0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    SCOPED_TRACE("pixel " + std::to_string(i));
    const Vec p = read.vec("p", i);
    if (read("s.I", i) == 0) {
      for (const Channel& channel : image.channels) ASSERT_EQ(channel.values[i], 0.0f) << channel.name;
      continue;
    }
    ++hits;
    EXPECT_EQ(read("s.I", i), 2);
    EXPECT_NEAR(dot(p - Vec{0, 0, 0.5}, kNormal), 0, 1e-5);
    // Half the picture's width is half the distance along the axis; x is to the right, y up.
    const double x = p.x / (origin.z - p.z), y = p.y / (origin.z - p.z);
    const double column = (x + 0.5) * kSize, row = (0.5 - y) * kSize;
    EXPECT_NEAR(column, static_cast<double>(i % kSize) + 0.5, 0.5 + 1e-4);
    const auto pixel_row = i / kSize;
    EXPECT_NEAR(row, static_cast<double>(pixel_row) + 0.5, 0.5 + 1e-4);
    const double distance = std::sqrt(dot(p - origin, p - origin));
    EXPECT_NEAR(read("d.T", i), distance, 1e-5);
    for (const char* channel : {"R", "G", "B", "dist.R"}) EXPECT_NEAR(read(channel, i), distance, 1e-5);
    expect_vec(read.vec("g", i), kNormal, 1e-6, "geometric normal");
    expect_vec(read.vec("n", i), kNormal, 1e-6, "shading normal");
    expect_vec(read.vec("pu", i), 6.0 * kAlongU, 1e-5, "dp/du");
    expect_vec(read.vec("pv", i), {0, 3, 0}, 1e-5, "dp/dv");
    EXPECT_NEAR(read("t.U", i), (dot(p - Vec{0, 0, 0.5}, kAlongU) / 3 + 1) / 2, 1e-5);
    EXPECT_NEAR(read("t.V", i), (p.y / 1.5 + 1) / 2, 1e-5);
    EXPECT_FLOAT_EQ(static_cast<float>(read("a.R", i)), 0.2f);
    EXPECT_FLOAT_EQ(static_cast<float>(read("a.G", i)), 0.5f);
    EXPECT_FLOAT_EQ(static_cast<float>(read("a.B", i)), 0.8f);
  }
  EXPECT_GT(hits, kSize * kSize / 2);
  EXPECT_LT(hits, kSize * kSize);
}

/// Depth is the mean of distances, not of depths along the axis, and a miss is 0.
TEST_F(Layers, DepthIsTheMeanDistance) {
  const std::string plane = R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/>
    <rotate y="1" angle="30"/><translate z="0.5"/></transform></shape>)";
  const Image image =
      render("<integrator type=\"depth\"/>" + camera(kSize) + plane + kLight, {.samples_per_pixel = 256});
  const Reader read{image};
  for (int row = 0; row < kSize; row += 5) {
    for (int column = 0; column < kSize; column += 3) {
      constexpr int kFine = 32;
      double sum = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const int across = k % kFine, down = k / kFine;
        const Vec d{(column + (across + 0.5) / kFine) / kSize - 0.5, 0.5 - (row + (down + 0.5) / kFine) / kSize, -1};
        // (0, 0, 4) + t d on the plane through (0, 0, 0.5).
        sum += -3.5 * kNormal.z / dot(d, kNormal) * std::sqrt(dot(d, d)) / (kFine * kFine);
      }
      EXPECT_NEAR(read("G", static_cast<std::size_t>(row * kSize + column)), sum, 2e-4 * sum);
    }
  }
  const Image missed = render("<integrator type=\"depth\"/>" + camera(kSize, {.target = "0, 0, 8"}) + plane + kLight,
                              {.samples_per_pixel = 4});
  for (const float value : missed.find("R")->values) EXPECT_EQ(value, 0.0f);
}

/// Normals are on the shape's side, whichever is seen.
TEST_F(Layers, NormalsFollowTheShapeAndNotTheView) {
  for (const bool flipped : {false, true}) {
    for (const bool below : {false, true}) {
      const Image image =
          render(aov("g:geo_normal,n:sh_normal") + camera(8, {.origin = below ? "0, 0, -4" : "0, 0, 4"}) +
                     R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>
                     <boolean name="flip_normals" value=")" +
                     (flipped ? "true" : "false") + "\"/></shape>" + kLight,
                 {.samples_per_pixel = 1});
      const double z = flipped ? -1 : 1;
      for (std::size_t i = 0; i < 64; ++i) {
        expect_vec(Reader{image}.vec("g", i), {0, 0, z}, 1e-6, below ? "from below" : "from above");
        expect_vec(Reader{image}.vec("n", i), {0, 0, z}, 1e-6, below ? "from below" : "from above");
      }
    }
  }
}

/// Even where they lie in one plane, which small scenes merge if nobody counts.
TEST_F(Layers, PrimitivesAreCountedWithinTheirMesh) {
  write("two.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3\nf 1 3 4\n");
  const Image image =
      render(aov("i:prim_index,p:position,s:shape_index") + camera(kSize) +
                 R"(<shape type="obj"><string name="filename" value="two.obj"/><transform name="to_world">
                                 <translate z="-50"/></transform></shape>)" +
                 R"(<shape type="obj"><string name="filename" value="two.obj"/></shape>)" + kLight,
             {.samples_per_pixel = 1});
  const Reader read{image};
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    ASSERT_EQ(read("s.I", i), 2);
    ASSERT_EQ(read("i.I", i), read("p.Y", i) > read("p.X", i) ? 1 : 0);
  }
}

/// A sphere's v goes from its pole at +z to that at -z, its u around from +x, wherever it is turned.
/// Source: Mitsuba 3, plugin reference of `sphere`.
void expect_sphere_coordinates(const Reader& read, const Vec& center, const std::array<Vec, 3>& axes) {
  int hits = 0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    if (read("s.I", i) == 0) continue;
    const Vec p = read.vec("p", i) - center;
    const double length = std::sqrt(dot(p, p));
    const double x = dot(p, axes[0]) / length, y = dot(p, axes[1]) / length, z = dot(p, axes[2]) / length;
    if (x * x + y * y < 1e-3) continue;
    ++hits;
    const double u = std::atan2(y, x) / (2 * M_PI);
    EXPECT_NEAR(std::remainder(read("t.U", i) - u, 1.0), 0, 1e-4) << "pixel " << i;
    EXPECT_NEAR(read("t.V", i), std::acos(std::clamp(z, -1.0, 1.0)) / M_PI, 1e-4) << "pixel " << i;
    // dp/du goes around the sphere's own axis, dp/dv from its pole.
    const Vec du = read.vec("du", i), dv = read.vec("dv", i);
    expect_vec({dot(du, axes[0]), dot(du, axes[1]), dot(du, axes[2])},
               {-2 * M_PI * y * length, 2 * M_PI * x * length, 0}, 2e-3 * length, "dp/du");
    EXPECT_NEAR(dot(dv, axes[2]), -M_PI * length * std::sqrt(x * x + y * y), 2e-3 * length);
    EXPECT_NEAR(dot(dv, p), 0, 2e-3 * length * length);
  }
  EXPECT_GT(hits, 100);
}

TEST_F(Layers, TrianglesWithoutCoordinatesHaveTheirEdgesForTangents) {
  write("m.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
  const Image image = render(aov("du:dp_du,dv:dp_dv,s:shape_index") + camera(kSize) +
                                 R"(<shape type="obj"><string name="filename" value="m.obj"/></shape>)" + kLight,
                             {.samples_per_pixel = 1});
  const Reader read{image};
  int hits = 0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    if (read("s.I", i) == 0) continue;
    ++hits;
    expect_vec(read.vec("du", i), {2, 0, 0}, 1e-5, "dp/du");
    expect_vec(read.vec("dv", i), {2, 2, 0}, 1e-5, "dp/dv");
  }
  EXPECT_GT(hits, 20);
}

const std::string kSphereLayers = aov("p:position,t:uv,du:dp_du,dv:dp_dv,s:shape_index");
// Rotated about x by 90 degrees, then about z by 30.
const double kCos = std::sqrt(0.75), kSin = 0.5;
const std::array<Vec, 3> kTurned{Vec{kCos, kSin, 0}, Vec{0, 0, 1}, Vec{kSin, -kCos, 0}};
const std::string kTurn = R"(<rotate x="1" angle="90"/><rotate z="1" angle="30"/>)";

TEST_F(Layers, SpheresTakeTheirCoordinatesAlong) {
  const Image image =
      render(kSphereLayers + camera(kSize) + R"(<shape type="sphere"><transform name="to_world"><scale value="1.2"/>)" +
                 kTurn + R"(<translate x="0.3" y="-0.2" z="0.1"/></transform></shape>)" + kLight,
             {.samples_per_pixel = 1});
  expect_sphere_coordinates({image}, {0.3, -0.2, 0.1}, kTurned);
}

TEST_F(Layers, InstancesTakeTheCoordinatesOfTheirSpheresAlong) {
  const Image image = render(
      kSphereLayers + camera(kSize) +
          R"(<shape type="shapegroup" id="group"><shape type="sphere"><point name="center" value="0.5, 0, 0"/></shape>
          </shape><shape type="instance"><ref id="group"/><transform name="to_world"><scale value="1.2"/>)" +
          kTurn + R"(<translate x="0.1" y="-0.3" z="0.1"/></transform></shape>)" + kLight,
      {.samples_per_pixel = 1});
  expect_sphere_coordinates({image}, {0.1 + 0.6 * kCos, -0.3 + 0.6 * kSin, 0.1}, kTurned);
}

/// Of independent samples the mean of the squares tells the variance of the mean.
TEST_F(Layers, SecondMomentsTellTheVariance) {
  constexpr int kSamples = 64;
  const Image image = render_image(
      load_elements(R"(<integrator type="moment"><integrator type="path" name="image">)" + integer("max_depth", 3) +
                    "</integrator></integrator>" + camera(kSize, kAbove, R"(<rfilter type="box"/>)", "independent") +
                    R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>)" +
                    diffuse("0.5") + R"(</shape><shape type="rectangle"><transform name="to_world">
                    <rotate x="1" angle="180"/><scale value="0.3"/><translate x="0.5" z="1"/></transform>
                    <bsdf type="diffuse"/><emitter type="area"><float name="radiance" value="3"/></emitter></shape>)"),
      {.samples_per_pixel = kSamples, .threads = kThreads}, true);
  const Reader read{image};
  double variance = 0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    // Grey light, whose Y is 1 of 1.
    const double mean = read("G", i), second = read("m2_image.Y", i);
    EXPECT_NEAR(read("image.Y", i), mean, 2e-6 * mean);
    EXPECT_NEAR((second - mean * mean) / (kSamples - 1), read("variance.G", i), 1e-4 * second / kSamples);
    // White of D65.
    EXPECT_NEAR(read("m2_image.X", i), 0.950456 * 0.950456 * second, 1e-4 * second);
    EXPECT_NEAR(read("m2_image.Z", i), 1.089058 * 1.089058 * second, 1e-3 * second);
    variance += second - mean * mean;
  }
  EXPECT_GT(variance, 0.01);
}

/// What is seen through a mask with probability 3/4 has two values.
TEST_F(Layers, SecondMomentsOfTwoValues) {
  const Image image = render(R"(<integrator type="moment"><integrator type="path"/></integrator>)" + camera(kSize) +
                                 R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>
          <bsdf type="mask"><float name="opacity" value="0.25"/><bsdf type="diffuse"><float name="reflectance" value="0"/>
          </bsdf></bsdf></shape><shape type="rectangle"><transform name="to_world"><scale value="10"/><translate z="-1"/>
          </transform><bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf>
          <emitter type="area"><float name="radiance" value="4"/></emitter></shape>)",
                             {.samples_per_pixel = 256});
  double first = 0, second = 0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    first += Reader{image}("_arg_0.Y", i) / (kSize * kSize);
    second += Reader{image}("m2__arg_0.Y", i) / (kSize * kSize);
  }
  // Of 147456 samples.
  EXPECT_NEAR(first, 3, 0.02);
  EXPECT_NEAR(second, 12, 0.08);
  EXPECT_NEAR(second, 4 * first, 1e-4);
}

}  // namespace
}  // namespace norrsken::end_to_end
