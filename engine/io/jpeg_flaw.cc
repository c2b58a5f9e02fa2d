#include "engine/io/jpeg_flaw.h"

// Each needs the one before.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <algorithm>
#include <csetjmp>
#include <fstream>
#include <string>

#include "engine/io/file.h"
#include "engine/io/text.h"
#include "engine/io/unread_image.h"

namespace quorum {
namespace {

constexpr std::string_view kEnd = "\xff\xd9";

/// What libjpeg warned of.
struct Warnings {
  std::jmp_buf give_up;
  bool at_end = false;   ///< the file ended without the marker
  bool too_few = false;  ///< codes in a segment
  bool damaged = false;
  int row = 0;          ///< at the first of these two
  bool padded = false;  ///< with zeros before a marker
};

Warnings& warnings_of(j_common_ptr info) { return *static_cast<Warnings*>(info->client_data); }

[[noreturn]] void give_up(j_common_ptr info) { std::longjmp(warnings_of(info).give_up, 1); }

/// True if the bytes that were skipped before a marker are zeros.
bool skipped_zeros(const jpeg_decompress_struct& info, int count) {
  const auto* end = info.src->next_input_byte;
  return std::all_of(end - count, end, [](JOCTET byte) { return byte == 0; });
}

/// level: below 0 for warnings.
void take_warning(j_common_ptr common, int level) {
  if (level >= 0) return;
  const auto& info = *reinterpret_cast<jpeg_decompress_struct*>(common);
  Warnings& warnings = warnings_of(common);
  const bool was_fine = !warnings.damaged && !warnings.too_few;
  switch (common->err->msg_code) {
    case JWRN_JPEG_EOF:
      warnings.at_end = true;
      break;
    case JWRN_HIT_MARKER:
      warnings.too_few = true;
      break;
    case JWRN_EXTRANEOUS_DATA:
      (skipped_zeros(info, common->err->msg_parm.i[0]) ? warnings.padded : warnings.damaged) = true;
      break;
    case JWRN_HUFF_BAD_CODE:
    case JWRN_ARITH_BAD_CODE:
    case JWRN_MUST_RESYNC:
      warnings.damaged = true;
      break;
    default:  // of profiles, versions, color transforms
      break;
  }
  constexpr int kScale = 8;
  if (was_fine && (warnings.damaged || warnings.too_few))
    warnings.row = kScale * static_cast<int>(info.output_scanline);
}

/// False where libjpeg gives up. A C function in all but name: it is left by a jump, so nothing in it has a destructor.
bool read_codes(jpeg_decompress_struct& info, Warnings& warnings, std::string_view bytes) {
  if (setjmp(warnings.give_up) != 0) return false;
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&info, TRUE);
  info.scale_num = 1;
  info.scale_denom = 8;
  info.dct_method = JDCT_IFAST;
  info.do_fancy_upsampling = FALSE;
  info.out_color_space = info.jpeg_color_space;
  jpeg_start_decompress(&info);
  auto* const row = (*info.mem->alloc_sarray)(reinterpret_cast<j_common_ptr>(&info), JPOOL_IMAGE,
                                              info.output_width * static_cast<JDIMENSION>(info.output_components), 1);
  while (info.output_scanline < info.output_height) jpeg_read_scanlines(&info, row, 1);
  jpeg_finish_decompress(&info);
  return true;
}

bool begins_as_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"); }

}  // namespace

JpegFlaw find_jpeg_flaw(std::string_view bytes) {
  if (!begins_as_jpeg(bytes)) return {};
  Warnings warnings;
  jpeg_error_mgr errors = {};
  jpeg_decompress_struct info = {};
  info.err = jpeg_std_error(&errors);
  info.client_data = &warnings;
  errors.error_exit = give_up;
  errors.emit_message = take_warning;
  const bool done = read_codes(info, warnings, bytes);
  const bool in_one_scan = done && info.progressive_mode == FALSE && info.comps_in_scan == info.num_components;
  JpegFlaw flaw{JpegFlaw::Kind::kNone, warnings.row, static_cast<int>(info.image_height)};
  jpeg_destroy_decompress(&info);
  if (!done) return {};
  const bool is_whole = in_one_scan && !warnings.too_few && !warnings.padded;
  if (warnings.damaged || (warnings.too_few && !warnings.at_end))
    flaw.kind = JpegFlaw::Kind::kDamaged;
  else if (warnings.at_end)
    flaw.kind = is_whole ? JpegFlaw::Kind::kNoEnd : JpegFlaw::Kind::kCut;
  return flaw;
}

Expected<bool> is_jpeg_without_end(const std::filesystem::path& path) {
  constexpr std::streamoff kLookedAt = 64 << 10;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(2, '\0');
  if (!file.read(bytes.data(), 2) || !begins_as_jpeg(bytes)) return false;
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  file.seekg(std::max(std::streamoff{2}, size - kLookedAt));
  bytes.assign(kLookedAt, '\0');
  file.read(bytes.data(), kLookedAt);
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  // Within a small file the marker may be that of a thumbnail.
  if (bytes.ends_with(kEnd) || (size > 2 * kLookedAt && bytes.contains(kEnd))) return false;
  QUORUM_ASSIGN(bytes, read_file(path));
  if (const std::string why = why_unread(path, bytes, true); !why.empty()) return path_failure(path, why);
  return find_jpeg_flaw(bytes).kind == JpegFlaw::Kind::kNoEnd;
}

}  // namespace quorum
