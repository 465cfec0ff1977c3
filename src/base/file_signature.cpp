#include "base/file_signature.h"

#include <algorithm>
#include <iterator>

namespace norrsken {
namespace {

using namespace std::string_view_literals;

constexpr FileSignature kSignatures[] = {
    {"\x76\x2f\x31\x01"sv, "an OpenEXR image", FileKind::read_image},
    {"\x89PNG"sv, "a PNG image", FileKind::read_image},
    {"\xff\xd8\xff"sv, "a JPEG image", FileKind::read_image},
    {"#?RADIANCE"sv, "a Radiance HDR image", FileKind::read_image},
    {"#?RGBE"sv, "a Radiance HDR image", FileKind::read_image},
    {"II*\0"sv, "a TIFF image", FileKind::read_image},
    {"MM\0*"sv, "a TIFF image", FileKind::read_image},
    {"PF\n"sv, "a PFM image", FileKind::read_image},
    {"Pf\n"sv, "a PFM image", FileKind::read_image},
    {"P1\n"sv, "a PBM image", FileKind::read_image},
    {"P2\n"sv, "a PGM image", FileKind::read_image},
    {"P3\n"sv, "a PPM image", FileKind::read_image},
    {"P4\n"sv, "a PBM image", FileKind::read_image},
    {"P5\n"sv, "a PGM image", FileKind::read_image},
    {"P6\n"sv, "a PPM image", FileKind::read_image},
    {"GIF8"sv, "a GIF image", FileKind::other_image},
    {"8BPS"sv, "a Photoshop image", FileKind::other_image},
    {"DDS "sv, "a DDS image", FileKind::other_image},
    {"\xabKTX "sv, "a KTX image", FileKind::other_image},
    {"\x13\xab\xa1\x5c"sv, "an ASTC image", FileKind::other_image},
    {"\0\0\0\x0cjP  "sv, "a JPEG 2000 image", FileKind::other_image},
    {"\xff\x4f\xff\x51"sv, "a JPEG 2000 image", FileKind::other_image},
    {"\0\0\0\x0cJXL "sv, "a JPEG XL image", FileKind::other_image},
    {"\xff\x0a"sv, "a JPEG XL image", FileKind::other_image},
    {"P7\n"sv, "a PAM image", FileKind::other_image},
    {"\0\0\1\0"sv, "an icon (ICO)", FileKind::other_image},
    {"SDPX"sv, "a DPX image", FileKind::other_image},
    {"XPDS"sv, "a DPX image", FileKind::other_image},
    {"\x80\x2a\x5f\xd7"sv, "a Cineon image", FileKind::other_image},
    {"\x01\xda"sv, "an SGI image", FileKind::other_image},
    {"SIMPLE  ="sv, "a FITS image", FileKind::other_image},
    {"gimp xcf"sv, "a GIMP image", FileKind::other_image},
    {"VOL\x03"sv, "a volume", FileKind::volume},
    {" BDV"sv, "a volume (OpenVDB)", FileKind::other},
    {"BLENDER"sv, "a Blender file", FileKind::scene},
    {"\x28\xb5\x2f\xfd"sv, "a packed file (Zstandard), such as Blender's", FileKind::scene},
    {"glTF"sv, "a glTF scene", FileKind::scene},
    {"PXR-USDC"sv, "a USD scene", FileKind::scene},
    {"#usda"sv, "a USD scene", FileKind::scene},
    {"Kaydara FBX"sv, "an FBX scene", FileKind::scene},
    {"; FBX "sv, "an FBX scene", FileKind::scene},
    {"Ogawa"sv, "an Alembic scene", FileKind::scene},
    {"\x89HDF"sv, "an HDF file, such as older ones of Alembic", FileKind::scene},
    {"\x1f\x8b"sv, "a packed file (gzip)", FileKind::packed},
    {"PK\x03\x04"sv, "a packed file (ZIP)", FileKind::packed},
    {"7z\xbc\xaf"sv, "a packed file (7-Zip)", FileKind::packed},
    {"Rar!"sv, "a packed file (RAR)", FileKind::packed},
    {"BZh"sv, "a packed file (bzip2)", FileKind::packed},
    {"\xfd\x37zXZ"sv, "a packed file (xz)", FileKind::packed},
    {"\x89Norrsk\n"sv, "a checkpoint of this program", FileKind::checkpoint},
    {"%PDF"sv, "a PDF document", FileKind::other},
};

// Containers whose first bytes are a size, and what they contain is said behind it.
constexpr FileSignature kWebp = {"RIFF"sv, "a WebP image", FileKind::other_image};
constexpr FileSignature kHeif = {"\0"sv, "a HEIF or AVIF image", FileKind::other_image};

}  // namespace

const FileSignature* file_signature(std::string_view contents) {
  const auto says = [&](const FileSignature& container, std::size_t at, std::string_view word) {
    return contents.starts_with(container.start) && contents.size() > at && contents.substr(at).starts_with(word);
  };
  if (says(kWebp, 8, "WEBP")) return &kWebp;
  if (says(kHeif, 4, "ftyp")) return &kHeif;
  const auto* found = std::ranges::find_if(
      kSignatures, [&](const FileSignature& signature) { return contents.starts_with(signature.start); });
  return found == std::end(kSignatures) ? nullptr : found;
}

}  // namespace norrsken
