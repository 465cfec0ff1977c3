// How far two images are apart.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "norrsken/image.h"
#include "norrsken/memory.h"
#include "norrsken/result.h"

namespace norrsken {

/// Figures over all pixels of R, G, B, of the image `a` against the reference `b`; X, Y, Z are converted, and if one has
/// luminance alone (Y), both are compared by it. Where just one image is infinite, the figures of linear radiance are
/// infinite; PSNR and FLIP see what a PNG would show. With a NaN in either image all of them are NaN.
struct Comparison {
  double mse = 0;      ///< mean squared error of linear radiance, over pixels and channels
  double rel_mse = 0;  ///< mean of (a-b)^2 / (b^2 + 0.01), as in Rousselle et al. 2011
  double psnr = 0;     ///< dB, of the tone-mapped images in [0,1]; infinity for equal images
  double flip = 0;     ///< mean LDR-FLIP of the tone-mapped images (Andersson et al. 2020), 0 to 1
  double mean_a = 0;   ///< mean of all channels
  double mean_b = 0;
  std::uint64_t nan_a = 0, nan_b = 0;  ///< pixels with a NaN

  /// Pixel-wise test of "both estimate the same image", where at least one image carries `variance.R/G/B` (the variance
  /// of the mean). If the other has none, that does not make it free of noise: what both have together is estimated from the
  /// differences between neighbouring pixels' errors, and taken where it is more than the variance that is known. Pixel
  /// channels without variance on either side must be equal; those whose variance is unknown (NaN, infinite, negative) are
  /// left out.
  struct ZTest {
    enum class Estimated { neither, a, b } estimated = Estimated::neither;  ///< whose noise is estimated
    double passed_share = 0;  ///< share of pixel channels not rejected at the Sidak-corrected 1 % level
    double mean_z[3] = {};    ///< z-score of the difference of the whole-image means, per channel
    double rms_z = 0;         ///< root mean square of the pixel z-scores; 1 for honest variances and equal means
  };
  std::optional<ZTest> z_test;

  Image difference;  ///< if CompareOptions::difference asks for it: channels R, G, B = |a - b|, and `flip`
};

struct CompareOptions {
  ToneMapping tone;                           ///< for PSNR and FLIP
  std::shared_ptr<MemoryBudget> memory = {};  ///< for what it takes beside the images; empty: all that there is
  double pixels_per_degree = 67;              ///< FLIP's viewing condition: 0.7 m from a 0.7 m wide 3840-pixel screen
  bool difference = false;                    ///< whether to make an image of it
};

/// Compares `a` with the reference `b`. Errors: colours are missing, the sizes differ, too little memory.
Result<Comparison> compare(const Image& a, const Image& b, const CompareOptions& options = {});

}  // namespace norrsken
