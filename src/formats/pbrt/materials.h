// pbrt's materials, as nodes of a description.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>

#include "formats/pbrt/textures.h"

namespace norrsken::pbrt {

/// Which material a shape has: one by its number, or by a name that may still be defined.
struct MaterialUse {
  std::size_t number = 0;  ///< without a name
  std::string name = {};
  Place place = {};
};

class Materials {
 public:
  /// Number 0 is the one of files that name none.
  Materials(Context& context, Textures& textures);

  std::size_t add(std::string type, Parameters parameters, const ColorSpace& space);
  /// False if the name is taken.
  bool add_named(const std::string& name, std::string type, Parameters parameters, const ColorSpace& space);

  /// The bsdf; null after a complaint. It is the same one at each call.
  std::shared_ptr<const Node> node(const MaterialUse& use);
  /// Whether it is `interface`: no surface.
  bool is_interface(const MaterialUse& use) const;
  /// Whether (u, v) may matter to it, as far as is known yet.
  bool depends_on_uv(const MaterialUse& use) const;

  /// Reads those, too, that nothing uses.
  void finish();

 private:
  struct Definition {
    std::string type;
    Parameters parameters;
    const ColorSpace* space;
    std::shared_ptr<const Node> node = {};
    bool is_open = false;
  };
  /// Where the roughness of a surface is from: its slopes along u and v.
  struct Roughness {
    Pattern u, v;
    bool is_smooth() const;
  };

  const Definition* find(const MaterialUse& use) const;
  std::shared_ptr<const Node> read(Definition& definition);
  Node make(Definition& definition);
  Node make_mix(Definition& definition);
  Node make_conductor(Definition& definition, const std::string& prefix);
  Node make_coated_diffuse(Definition& definition);
  Node make_dielectric(Definition& definition);
  Node make_diffuse_transmission(Definition& definition);
  Node make_subsurface(Definition& definition);
  Node make_hair(Definition& definition);
  Node make_measured(Definition& definition);
  /// A dielectric coat over what scatters alike in all directions.
  Node make_plastic(const Parameters& p, const Pattern& reflectance, const Roughness& roughness, double eta);
  /// Around `inside`, the displacement or the normal map that the material has.
  Node with_relief(Definition& definition, Node inside);

  Roughness read_roughness(Parameters& p, const std::string& prefix, bool remap);
  void give_roughness(Node& node, const Roughness& roughness, const Place& place);

  Context& context_;
  Textures& textures_;
  std::deque<Definition> definitions_;
  std::map<std::string, std::size_t> names_;
};

}  // namespace norrsken::pbrt
