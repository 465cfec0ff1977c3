// What the reader of OBJ files notes of materials on its way.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/memory.h"
#include "formats/mesh_data.h"
#include "formats/mesh_readers.h"

namespace norrsken {

class ObjMaterialNotes {
 public:
  /// Nothing is noted if it is null.
  explicit ObjMaterialNotes(ObjMaterials* into) : into_(into) {}

  bool takes(std::string_view keyword) const {
    return into_ != nullptr && (keyword == "usemtl" || keyword == "mtllib" || keyword == "s");
  }

  /// `rest` is what stands behind the keyword.
  void statement(std::string_view keyword, std::string rest) {
    if (keyword == "usemtl") {
      const auto [known, is_new] = numbers_.try_emplace(std::move(rest), into_->names.size());
      if (is_new) into_->names.push_back(known->first);
      current_ = static_cast<float>(known->second);
    } else if (keyword == "mtllib") {
      into_->libraries.insert(std::move(rest));
    } else {
      into_->is_smooth = into_->is_smooth || (rest != "off" && rest != "0");
    }
  }

  /// There are so many triangles now.
  void note(std::size_t triangles) {
    if (into_ != nullptr) of_triangle_.resize(triangles, current_);
  }

  void give_to(MeshData& mesh) {
    if (into_ != nullptr)
      mesh.attributes.push_back({std::string(ObjMaterials::kAttribute), 1, true, std::move(of_triangle_)});
  }

 private:
  ObjMaterials* into_;
  std::map<std::string, std::size_t> numbers_;
  float current_ = -1;
  Array<float> of_triangle_;
};

}  // namespace norrsken
