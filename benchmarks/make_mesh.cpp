// Writes meshes to measure with: a displaced sphere of about so many triangles inside the hexagon room.
//
//   make_mesh FOLDER [--triangles N] [--format ply|obj|serialized] [--bare]
//
// FOLDER/mesh.ply, mesh.obj or mesh.serialized is the mesh, FOLDER/scene.xml the room with it. `--bare` leaves out normals and texture
// coordinates.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>

#include "displaced_sphere.h"

int main(int argc, char** argv) try {
  CLI::App app{"Writes a displaced sphere in the hexagon room."};
  std::string folder, format = "ply";
  std::uint32_t triangles = 1000000;
  bool bare = false;
  app.add_option("FOLDER", folder, "where mesh and scene.xml go")->required();
  app.add_option("--triangles", triangles, "about how many")->check(CLI::Range(8u, 1000000000u));
  app.add_option("--format", format, "of the mesh")->check(CLI::IsMember({"ply", "obj", "serialized"}));
  app.add_flag("--bare", bare, "no normals, no texture coordinates");
  CLI11_PARSE(app, argc, argv);

  const norrsken::SphereGrid grid = norrsken::sphere_grid(triangles, bare);
  const std::filesystem::path mesh = norrsken::write_scene(grid, format, folder);
  fmt::print("{}: {} triangles, {} vertices, {:.1f} MB\n", mesh.string(), grid.triangle_count(), grid.vertex_count(),
             static_cast<double>(std::filesystem::file_size(mesh)) / 1e6);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "make_mesh: {}\n", error.what());
  return 1;
}
