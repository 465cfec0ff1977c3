// sggx: host side.
//
// As in Mitsuba the projected area of the flakes, by the direction that light comes from, is a factor on the extinction of
// the medium. `S` is a volume of six channels, the matrix's xx, yy, zz, xy, xz, yz: it has to be positive definite.
#include "medium/sggx.h"

#include "base/text.h"
#include "compile/media.h"

namespace norrsken {
namespace {

constexpr VolumeParameter kS{.name = "S", .text = "the flakes' matrix: a volume of six channels"};

}  // namespace

PhaseWord compile_phase_sggx(Parameters& p, Media& media) {
  const Node::Child* child = p.read(kS);
  const Volume volume = child ? media.volume(*child->node) : Volume{};
  if (volume.index == kNone) return 0;
  const VolumeRecord& record = media.tables().volumes[volume.index];
  if (record.size_x > 0 && record.channels != 6) {
    p.error(kS.name, "a volume of " + std::to_string(record.channels) + " channels", "6 channels");
    return 0;
  }
  return media.add(isa_host::Sggx::Stored{.volume = volume.index});
}

}  // namespace norrsken
