// What a scene asks for besides its image: layers of EXR files.
#pragma once

#include <string>
#include <vector>

#include "tables/film_view.h"

namespace norrsken {

/// One plane of features, by the name that its channel has.
struct FeatureLayer {
  std::string name;
  Feature feature;
};

struct SceneLayers {
  std::vector<FeatureLayer> features;
  std::vector<std::string> image_copies;  ///< NAME: R, G, B and A of the image as NAME.R, NAME.G, ... too
  std::vector<std::string> moments;       ///< NAME: X, Y, Z as NAME.X, ..., their second moments as m2_NAME.X, ...
};

}  // namespace norrsken
