#include "engine/texture/assemble.h"

#include <utility>

namespace quorum {
namespace {

class Assembly {
 public:
  explicit Assembly(const Mesh& mesh) : mesh_(mesh), places_(mesh.vertices.size()), groups_(mesh.vertices.size()) {
    made.mesh.offset = mesh.offset;
  }

  /// From here on vertices are new ones.
  void begin_group() { ++group_; }
  /// What follows is on the next page.
  void begin_page() {
    made.first_triangles.push_back(static_cast<std::uint32_t>(made.mesh.triangles.size()));
    made.first_vertices.push_back(static_cast<std::uint32_t>(made.mesh.vertices.size()));
  }

  /// coordinates_of(corner): of its page.
  template <typename Coordinates>
  void add(std::uint32_t triangle, const Coordinates& coordinates_of) {
    std::array<std::uint32_t, 3> corners{};
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh_.triangles[triangle][corner];
      if (groups_[vertex] != group_) {
        groups_[vertex] = group_;
        places_[vertex] = static_cast<std::uint32_t>(made.mesh.vertices.size());
        made.mesh.vertices.push_back(mesh_.vertices[vertex]);
        made.coordinates.push_back(coordinates_of(corner));
      }
      corners[corner] = places_[vertex];
    }
    made.mesh.triangles.push_back(corners);
  }

  TexturedMesh made;

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> places_;  ///< of a vertex in the group that it was added to last
  std::vector<std::uint32_t> groups_;
  std::uint32_t group_ = 0;
};

}  // namespace

TexturedMesh assemble(const Mesh& mesh, const std::vector<std::int32_t>& views, const OwnPlaces& places,
                      const Charts& charts, std::vector<ColorImage> pages) {
  Assembly assembly(mesh);
  int page = -1;
  for (const Chart& chart : charts.charts) {
    while (page < chart.page) {
      assembly.begin_page();
      ++page;
    }
    const PageSize size = charts.pages[static_cast<std::size_t>(page)];
    assembly.begin_group();
    for (const std::uint32_t t : charts.of(chart))
      assembly.add(t, [&](int corner) {
        // A pixel's center lies half a pixel inside of it.
        const ProjectedVertex place = places.corner(t, corner);
        const double x = static_cast<double>(place.x) / kSubpixels - chart.x + chart.page_x + 0.5;
        const double y = static_cast<double>(place.y) / kSubpixels - chart.y + chart.page_y + 0.5;
        return Eigen::Vector2f(static_cast<float>(x / size.width), static_cast<float>(y / size.height));
      });
  }
  assembly.begin_page();
  assembly.begin_group();
  for (std::uint32_t t = 0; t < views.size(); ++t)
    if (views[t] == kUnseen) assembly.add(t, [](int) { return Eigen::Vector2f(0, 0); });
  assembly.begin_page();
  assembly.made.pages = std::move(pages);
  return std::move(assembly.made);
}

}  // namespace quorum
