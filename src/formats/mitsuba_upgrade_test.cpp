// The upgrade of old scenes but for materials.
#include "formats/mitsuba_upgrade_testing.h"

namespace norrsken {
namespace {

TEST(MitsubaUpgrade, NamesOfParameters) {
  expect_same("0.6.0",
              R"(<integrator type="path"><integer name="maxDepth" value="4"/><integer name="rrDepth" value="3"/>
                   <boolean name="hideEmitters" value="true"/></integrator>
                 <bsdf type="dielectric" id="glass"><string name="intIOR" value="bk7"/><float name="extIOR" value="1"/>
                   <texture type="bitmap" name="specularReflectance"/></bsdf>
                 <bsdf type="twosided"><ref name="someName" id="glass"/></bsdf>)",
              R"(<integrator type="path"><integer name="max_depth" value="4"/><integer name="rr_depth" value="3"/>
                   <boolean name="hide_emitters" value="true"/></integrator>
                 <bsdf type="dielectric" id="glass"><string name="int_ior" value="bk7"/><float name="ext_ior" value="1"/>
                   <texture type="bitmap" name="specular_reflectance"/></bsdf>
                 <bsdf type="twosided"><ref name="some_name" id="glass"/></bsdf>)");
  expect_same("0.5.0", R"(<bsdf type="diffuse"><rgb name="diffuseReflectance" value="0.1, 0.2, 0.3"/></bsdf>)",
              R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.1 0.2 0.3"/></bsdf>)");
}

TEST(MitsubaUpgrade, ChangesAreToldWithTheirPlaces) {
  EXPECT_THAT(
      read("0.6.0", R"(<sensor type="perspective">
  <transform name="toWorld"><lookAt origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
  <sampler type="halton"><integer name="sampleCount" value="4"/><integer name="scramble" value="1"/></sampler>
</sensor>)")
          .changes,
      ElementsAre("room.xml:3:20: 'toWorld' is 'to_world'", "room.xml:3:29: <lookAt> is <lookat>",
                  "room.xml:4:18: sampler 'halton' is 'sobol'", "room.xml:4:41: 'sampleCount' is 'sample_count'",
                  "room.xml:4:97: 'scramble' is left out: the sampler knows by itself"));
  EXPECT_TRUE(read("2.1.0", R"(<shape type="sphere"/>)").changes.empty());
}

TEST(MitsubaUpgrade, OfVeryManyChangesTheFirstAreKept) {
  std::string shapes;
  for (int i = 0; i < 10002; ++i) shapes += R"(<shape type="sphere"><float name="aB" value="1"/></shape>)";
  const auto changes = read("0.6.0", shapes).changes;
  ASSERT_EQ(changes.size(), 10001U);
  EXPECT_EQ(changes.back(), ": 2 more changes");
}

TEST(MitsubaUpgrade, NewerScenesAreLeftAlone) {
  const std::string old = R"(<integrator type="path"><integer name="maxDepth" value="4"/></integrator>)";
  EXPECT_THAT(read("2.0.0", old).description, HasSubstr("maxDepth = 4"));
  EXPECT_EQ(read("2.0.0", old).complaints, "");
  EXPECT_THAT(read("2.0.0", R"(<luminaire type="area"/>)").complaints, HasSubstr("unknown element 'luminaire'"));
  EXPECT_THAT(read("3.0.0", R"(<srgb name="a" value="1"/>)").complaints, HasSubstr("unknown element 'srgb'"));
}

TEST(MitsubaUpgrade, AnIncludedFileMayBeOfAnotherVersion) {
  Diagnostics diagnostics;
  const auto scene = read_scene(
      TestFiles{
          {"room.xml", R"(<scene version="3.0.0"><include filename="a.xml"/><include filename="b.xml"/></scene>)"},
          {"a.xml", R"(<scene version="0.6.0"><include filename="c.xml"/></scene>)"},
          {"b.xml", R"(<scene><shape type="sphere"><float name="notOld" value="1"/></shape></scene>)"},
          {"c.xml", R"(<scene version="0.5.0"><shape type="sphere"><float name="isOld" value="1"/></shape></scene>)"}},
      {}, diagnostics);
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->scene->children.size(), 2U);
  EXPECT_EQ(scene->scene->children[0].node->properties[0].name, "is_old");
  EXPECT_EQ(scene->scene->children[1].node->properties[0].name, "notOld");
  EXPECT_EQ(diagnostics.all().size(), 1U) << "it is told once";
}

TEST(MitsubaUpgrade, TheFilesOwnWordIsKeptForComplaints) {
  Diagnostics diagnostics;
  const auto scene = read_scene(
      R"(<scene version="0.6"><shape type="sphere"><float name="isOld" value="1"/></shape></scene>)", {}, diagnostics);
  EXPECT_EQ(scene->scene->children[0].node->properties[0].file_name(), "isOld");
  EXPECT_THAT(read("0.6.0", R"(<integrator type="path"><integer name="maxDepth" value="1"/>
    <integer name="max_depth" value="2"/></integrator>)")
                  .complaints,
              HasSubstr("error: 'max_depth' is already given in line 2"));
}

TEST(MitsubaUpgrade, Colours) {
  expect_same("0.6.0",
              R"(<srgb name="a" value="#804020"/><srgb name="b" value="1, 0.5, 0"/><srgb name="c" value="0"/>)",
              R"(<rgb name="a" value="#804020"/><rgb name="b" value="1 0.21404114 0"/><rgb name="c" value="0"/>)");
  expect_same("0.6.0", R"(<rgb name="a" value="#ff3300"/><rgb name="b" value="0.5" intent="illuminant"/>)",
              R"(<rgb name="a" value="1 0.2 0"/><rgb name="b" value="0.5"/>)");
  expect_same("0.5.0", R"(<spectrum name="a" value="0.1, 0.2, 0.3"/><spectrum name="b" value="400:1, 700:2"/>
                          <spectrum name="c" value="0.5" intent="reflectance"/>)",
              R"(<rgb name="a" value="0.1 0.2 0.3"/><spectrum name="b" value="400:1, 700:2"/>
                 <spectrum name="c" value="0.5"/>)");
}

TEST(MitsubaUpgrade, BlackBodies) {
  const auto first_sample = [](const std::string& version, const std::string& attributes) {
    Diagnostics diagnostics;
    const auto scene = read_scene(
        fmt::format("<scene version=\"{}\"><blackbody name=\"r\" {}/></scene>", version, attributes), {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics);
    const auto& spectrum = std::get<Property::Spectrum>(scene->scene->properties.at(0).value);
    return spectrum.samples.at(38).second;  // 550 nm
  };
  // Planck's law at 550 nm and 5000 K, in W/(m^2 sr nm).
  EXPECT_NEAR(first_sample("0.6.0", "temperature=\"5000K\""), 12687.0, 30);
  EXPECT_DOUBLE_EQ(first_sample("0.6.0", "temperature=\"5000\" scale=\"2\""),
                   2 * first_sample("0.6.0", "temperature=\" 5000k \""));
  EXPECT_DOUBLE_EQ(first_sample("0.3.0", "temperature=\"5000\" multiplier=\"0.5\""),
                   0.5 * first_sample("0.6.0", "temperature=\"5000\""));
  EXPECT_THAT(read("0.6.0", R"(<blackbody name="r" temperature="hot"/>)").complaints,
              HasSubstr("error: 'hot' is not a number"));
  EXPECT_THAT(read("0.6.0", R"(<blackbody name="r" temperature="-3K"/>)").complaints,
              HasSubstr("error: '-3' is not a temperature"));
}

TEST(MitsubaUpgrade, Films) {
  expect_same(
      "0.5.0", R"(<film type="ldrfilm"><integer name="width" value="8"/><string name="fileFormat" value="png"/>
                            <string name="pixelFormat" value="luminanceAlpha"/><float name="gamma" value="2.2"/>
                            <string name="tonemapMethod" value="gamma"/><float name="exposure" value="0"/>
                            <integer name="cropOffsetX" value="3"/><boolean name="banner" value="false"/></film>)",
      R"(<film type="hdrfilm"><integer name="width" value="8"/><string name="pixel_format" value="luminance_alpha"/>
                   <integer name="crop_offset_x" value="3"/><boolean name="banner" value="false"/></film>)");
  expect_same_but("0.5.0", R"(<film type="ldrfilm"><float name="exposure" value="2"/></film>)",
                  R"(<film type="hdrfilm"/>)",
                  "'exposure' is left out: tone mapping is chosen when the image is written");
  expect_same("0.6.0", R"(<film type="hdrfilm"><boolean name="attachLog" value="false"/>
                            <string name="label[10, 10]" value="x"/><string name="fileFormat" value="openexr"/></film>)",
              R"(<film type="hdrfilm"><string name="file_format" value="openexr"/></film>)");
  expect_same("0.6.0",
              R"(<film type="mfilm"><string name="fileFormat" value="numpy"/><integer name="width" value="2"/></film>)",
              R"(<film type="hdrfilm"><integer name="width" value="2"/><integer name="height" value="1"/></film>)");
}

TEST(MitsubaUpgrade, Integrators) {
  for (const char* plugin : {"bdpt", "erpt", "mlt", "photonmapper", "ppm", "pssmlt", "sppm"}) {
    expect_same_but("0.6.0",
                    fmt::format(R"(<integrator type="{}"><integer name="maxDepth" value="9"/>
                                              <integer name="luminanceSamples" value="7"/></integrator>)",
                                plugin),
                    R"(<integrator type="path"><integer name="max_depth" value="9"/></integrator>)",
                    fmt::format("integrator '{}' is 'path', which finds the same light in another way", plugin));
  }
  expect_same_but("0.6.0", R"(<integrator type="vpl"/>)",
                  R"(<integrator type="path"><integer name="max_depth" value="5"/></integrator>)", "integrator 'vpl'");
  expect_same("0.6.0", R"(<integrator type="volpath_simple"/>)", R"(<integrator type="volpath"/>)");
  const std::string path = R"(<integrator type="path"><integer name="maxDepth" value="3"/></integrator>)";
  for (const char* plugin : {"adaptive", "irrcache", "multichannel"}) {
    expect_same_but(
        "0.6.0",
        fmt::format(R"(<integrator type="{}"><float name="maxError" value="3"/>{}</integrator>)", plugin, path),
        R"(<integrator type="path"><integer name="max_depth" value="3"/></integrator>)",
        fmt::format("integrator '{}' is the 'path' inside of it", plugin));
  }
  // Whatever is inside, and wherever it stands.
  expect_same_but(
      "0.6.0",
      R"(<integrator type="bdpt" id="b"><integer name="maxDepth" value="3"/><string name="x" value="y"/></integrator>
                              <integrator type="adaptive"><integrator type="irrcache"><ref id="b"/></integrator></integrator>)",
      R"(<integrator type="path" id="b"><integer name="max_depth" value="3"/></integrator>
                     <integrator type="path"><integer name="max_depth" value="3"/></integrator>)",
      "integrator 'adaptive' is the 'path' inside of it");
  expect_same("0.6.0", R"(<integrator type="path"><boolean name="strictNormals" value="false"/></integrator>)",
              R"(<integrator type="path"/>)");
  expect_same_but("0.6.0", R"(<integrator type="path"><boolean name="strictNormals" value="true"/></integrator>)",
                  R"(<integrator type="path"/>)", "'strictNormals' is left out");
}

TEST(MitsubaUpgrade, FieldsAreLayers) {
  const auto field = [](const char* name) {
    return fmt::format(R"(<integrator type="field"><string name="field" value="{}"/></integrator>)", name);
  };
  const std::string path = R"(<integrator type="path"/>)";
  expect_same_but(
      "0.6.0", R"(<integrator type="multichannel">)" + path + field("shNormal") + field("distance") + "</integrator>",
      R"(<integrator type="aov">)" + path +
          R"(<string name="aovs" value="sh_normal:sh_normal,depth:depth"/></integrator>)",
      "integrator 'multichannel' is 'aov': its fields are layers beside the image");
  expect_same_but("0.6.0",
                  R"(<integrator type="multichannel">)" + field("relPosition") + path +
                      R"(<integrator type="direct"/></integrator>)",
                  path, "integrator 'direct' is left out: the image is that of the first one");
  expect_same("0.6.0", R"(<film type="hdrfilm"><string name="pixelFormat" value="rgb, rgb, luminance"/>
                          <string name="channelNames" value="color, normal, distance"/>
                          <string name="metadata['author']" value="me"/></film>)",
              R"(<film type="hdrfilm"><string name="pixel_format" value="rgb"/></film>)");
}

TEST(MitsubaUpgrade, LooksOfBefore03) {
  expect_same("0.2.1", R"(<shape type="sphere"><transform name="toWorld">
                          <lookAt ox="1" oy="2" oz="3" tx="4" ty="5" tz="7" ux="0" uy="1" uz="0"/></transform></shape>)",
              R"(<shape type="sphere"><transform name="to_world"><scale x="-1"/>
                 <lookat origin="1 2 3" target="4 5 7" up="0 1 0"/></transform></shape>)");
  expect_same("0.2.1", R"(<shape type="sphere"><transform name="toWorld">
                          <lookAt ox="1" oy="2" oz="3" tx="4" ty="5" tz="7"/></transform></shape>)",
              R"(<shape type="sphere"><transform name="to_world"><scale x="-1"/>
                 <lookat origin="1 2 3" target="4 5 7"/></transform></shape>)");
  EXPECT_THAT(
      read("0.2.1", R"(<shape type="sphere"><transform name="toWorld"><lookAt ox="1" oy="2"/></transform></shape>)")
          .complaints,
      HasSubstr("error: <lookAt> needs an attribute 'oz'"));
}

TEST(MitsubaUpgrade, LightsOfOneValue) {
  expect_same_but("0.6.0", R"(<emitter type="constant"><spectrum name="radiance" value="2"/></emitter>)",
                  R"(<emitter type="constant"><spectrum name="radiance" value="2"/></emitter>)",
                  "'radiance' of one value is light of equal energy");
}

TEST(MitsubaUpgrade, Shapes) {
  const std::string diffuse = R"(<bsdf type="diffuse"/>)";
  expect_same(
      "0.6.0",
      R"(<shape type="obj"><boolean name="faceNormals" value="true"/><boolean name="collapse" value="true"/>
                            <boolean name="flipNormals" value="true"/><boolean name="flipTexCoords" value="false"/>)" +
          diffuse + "</shape>",
      R"(<shape type="obj"><boolean name="face_normals" value="true"/><boolean name="flip_normals" value="true"/>
                   <boolean name="flip_tex_coords" value="false"/>)" +
          diffuse + "</shape>");
  expect_same_but("0.6.0", R"(<shape type="ply"><float name="maxSmoothAngle" value="30"/></shape>)",
                  R"(<shape type="ply"/>)", "'maxSmoothAngle' is left out: edges are smooth at any angle");
  expect_same_but("0.6.0", R"(<shape type="obj"/>)", R"(<shape type="obj"/>)", "a shape 'obj' without a bsdf is grey");
  expect_same("0.6.0", R"(<bsdf type="diffuse" id="a"/><shape type="obj"><ref id="a"/></shape>)",
              R"(<bsdf type="diffuse" id="a"/><shape type="obj"><ref id="a"/></shape>)");
  const std::string turned =
      R"(<shape type="obj"><boolean name="flip_tex_coords" value="false"/>)" + diffuse + "</shape>";
  expect_same("0.2.1", R"(<shape type="obj">)" + diffuse + "</shape>", turned);
  expect_same("0.2.0", R"(<shape type="sphere"><boolean name="inverted" value="true"/></shape>
                          <shape type="cylinder"><point name="p1" x="1" y="0" z="0"/><point name="p2" x="2" y="0" z="0"/></shape>)",
              R"(<shape type="sphere"><boolean name="flip_normals" value="true"/></shape>
                 <shape type="cylinder"><point name="p0" value="1 0 0"/><point name="p1" value="2 0 0"/></shape>)");
}

// What Mitsuba's own style sheets from 0.2, 0.3 and 0.4 on change.
TEST(MitsubaUpgrade, CamerasAndLuminaires) {
  expect_same(
      "0.3.0",
      R"(<camera type="perspective"><transform name="toWorld"><lookAt origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
                            <float name="fov" value="40"/><float name="focusDepth" value="3"/></camera>)",
      R"(<sensor type="perspective"><transform name="to_world"><scale x="-1"/><lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
                   <float name="fov" value="40"/><float name="focus_distance" value="3"/><string name="fov_axis" value="smaller"/></sensor>)");
  expect_same("0.3.0", R"(<camera type="perspective"><boolean name="mapSmallerSide" value="false"/></camera>)",
              R"(<sensor type="perspective"><string name="fov_axis" value="larger"/></sensor>)");
  expect_same("0.3.0", R"(<luminaire type="constant"><rgb name="intensity" value="1"/></luminaire>
                          <luminaire type="directional"><rgb name="intensity" value="1"/></luminaire>
                          <luminaire type="point"><rgb name="intensity" value="1"/></luminaire>)",
              R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
                 <emitter type="directional"><rgb name="irradiance" value="1"/></emitter>
                 <emitter type="point"><rgb name="intensity" value="1"/></emitter>)");
  expect_same(
      "0.3.0",
      R"(<film type="exrfilm"><boolean name="alpha" value="true"/></film><film type="pngfilm"><float name="gamma" value="2.2"/></film>
                          <sampler type="ldsampler"><integer name="depth" value="4"/></sampler>
                          <integrator type="direct"><integer name="luminaireSamples" value="4"/></integrator>)",
      R"(<film type="hdrfilm"><string name="pixel_format" value="rgba"/></film><film type="hdrfilm"/>
                 <sampler type="ldsampler"/><integrator type="direct"><integer name="emitter_samples" value="4"/></integrator>)");
  expect_same(
      "0.2.0", R"(<bsdf type="lambertian"/><bsdf type="mirror"/><texture type="ldrtexture"/>
                          <bsdf type="roughglass"><float name="alphaB" value="0.2"/></bsdf>)",
      R"(<bsdf type="diffuse"/><bsdf type="conductor"><string name="material" value="Cr"/></bsdf><texture type="bitmap"/>
                 <bsdf type="roughdielectric"><float name="alpha" value="0.2"/></bsdf>)");
  expect_same("0.4.0", R"(<bsdf type="bump"/>)", R"(<bsdf type="bumpmap"/>)");
}

TEST(MitsubaUpgrade, VersionsThatAreNone) {
  for (const char* version : {"", "old", "-1", "3.x", "99999"})
    EXPECT_THAT(read(version, "").complaints, HasSubstr("is not a version")) << version;
  EXPECT_EQ(read("3", "").complaints, "");
  EXPECT_THAT(read("4.0", "").complaints, HasSubstr("warning: the scene is for Mitsuba '4.0'"));
}

}  // namespace
}  // namespace norrsken
