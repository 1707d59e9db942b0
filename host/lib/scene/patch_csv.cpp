#include "scene/patch_csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "geometry/parse.hpp"
#include "scene/mesh.hpp"

namespace host {
namespace {

double number(const CsvTable& table, const CsvRow& row, std::size_t column) {
  std::string_view text = row.cells[column];
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw Error(fmt::format("{}:{}: {} is '{}', which is not a finite number", table.name, row.line,
                            table.header[column], row.cells[column]));
  return value;
}

// Columns of one colour; a single emission column stands for all three channels.
struct Columns {
  std::size_t label, polygon;
  std::array<std::size_t, 3> reflectance, exitance;

  explicit Columns(const CsvTable& table)
      : label(table.column("patch")),
        polygon(table.column("polygon")),
        reflectance{table.column("rho_r"), table.column("rho_g"), table.column("rho_b")} {
    if (const auto one = table.find("emit"))
      exitance = {*one, *one, *one};
    else
      exitance = {table.column("emit_r"), table.column("emit_g"), table.column("emit_b")};
  }
};

Material material_of(const CsvTable& table, const CsvRow& row, const Columns& columns) {
  Material material;
  for (std::size_t c = 0; c < 3; ++c) {
    const double reflectance = number(table, row, columns.reflectance[c]);
    const double exitance = number(table, row, columns.exitance[c]);
    if (reflectance < 0 || reflectance > 1)
      throw Error(fmt::format("{}:{}: {} is {}; a reflectance lies between 0 and 1", table.name,
                              row.line, table.header[columns.reflectance[c]], reflectance));
    if (!emission_in_range(exitance))
      throw Error(fmt::format("{}:{}: {} is {}; an emission is 0, or between 1e-30 and 1e30",
                              table.name, row.line, table.header[columns.exitance[c]], exitance));
    material.reflectance[int(c)] = reflectance;
    material.exitance[int(c)] = exitance;
  }
  return material;
}

}  // namespace

Scene read_patch_csv(const std::string& path) { return patch_csv_scene(read_csv(path)); }

Scene patch_csv_scene(const CsvTable& table) {
  const Columns columns(table);
  std::vector<Material> materials;
  std::map<std::tuple<double, double, double, double, double, double>, int> known;
  std::vector<Face> faces;
  std::set<std::string> labels;
  for (const CsvRow& row : table.rows) {
    Face face;
    face.where = fmt::format("{}:{}", table.name, row.line);
    if (!labels.insert(row.cells[columns.label]).second)
      throw Error(fmt::format("{}: patch '{}' stands in an earlier line already", face.where,
                              row.cells[columns.label]));
    if (!read_polygon(row.cells[columns.polygon], &face.polygon))
      throw Error(fmt::format("{}: polygon '{}' is not of the form 'x y z;x y z;x y z'", face.where,
                              row.cells[columns.polygon]));
    Material material = material_of(table, row, columns);
    const Vec3 &r = material.reflectance, &e = material.exitance;
    const auto [at, fresh] =
        known.emplace(std::make_tuple(r.x, r.y, r.z, e.x, e.y, e.z), int(materials.size()));
    face.material = at->second;
    if (fresh) {
      material.name = fmt::format("material_{}", materials.size());
      materials.push_back(material);
    }
    faces.push_back(std::move(face));
  }
  Meshed meshed = mesh_faces(table.name, std::move(materials), faces, {});
  Scene& scene = meshed.scene;
  for (const std::size_t face : meshed.face_of_patch)
    scene.patch_names.push_back(table.rows[face].cells[columns.label]);
  return std::move(meshed.scene);
}

}  // namespace host
