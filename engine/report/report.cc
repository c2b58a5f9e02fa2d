#include "engine/report/report.h"

#include <fmt/format.h>

#include <string>

#include "engine/io/file.h"
#include "engine/io/text.h"
#include "engine/report/page_data.h"
#include "engine/report/page_parts.h"

namespace quorum {
namespace {

constexpr std::string_view kDataElement = "<script type=\"application/json\" id=\"data\">";

void put(std::string& page, std::string_view place, const std::string& text) {
  const std::size_t at = page.find(place);
  page.replace(at, place.size(), text);
}

}  // namespace

Expected<void> write_report(const Scene& scene, const Workspace& workspace, const MemoryBudget& budget,
                            Progress& progress) {
  const std::filesystem::path path = workspace.folder() / "report.html";
  if (const auto old = read_file(path); old && !old->contains(kDataElement))
    return path_failure(path, "is there already and was not written by quorum; rename it");
  QUORUM_ASSIGN(const auto data, page_data(scene, workspace, budget, progress));
  std::string page(kPageHtml);
  put(page, "<!--style-->", fmt::format("<style>\n{}</style>", kPageStyle));
  put(page, "<!--script-->",
      fmt::format("<script>{}</script>\n<script>{}</script>\n<script>\n{}</script>", kPageThree, kPageControls,
                  kPageScript));
  put(page, "<!--data-->", fmt::format("{}{}</script>", kDataElement, data));
  return write_file(path, page);
}

}  // namespace quorum
