// A scene whose form factors are a table of integers: what a solver sees, without geometry.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "network/random.hpp"
#include "urad/urad.h"

namespace host {

class TableRoom {
 public:
  TableRoom(int surfaces, int patches_each, bool closed);
  TableRoom(const TableRoom&) = delete;
  TableRoom& operator=(const TableRoom&) = delete;

  int patches() const { return scene_.patch_count; }
  const urad_scene& scene() const { return scene_; }
  urad_source source();

  /// Areas spread over a factor `spread`, on a logarithmic scale.
  void spread_areas(double spread, Random& random);
  /// Reflectance 0 .. 1 and exitance in integers, all channels of a surface.
  void set(int surface, const double (&reflectance)[3], const std::int32_t (&exitance)[3]);
  /// Exchanges at random, scaled until every row sums to `sum`: A_i F_ij = A_j F_ji.
  void fill_reciprocal(double sum, Random& random);
  /// Any rows, their sums from 0 to `most`.
  void fill_anything(double most, Random& random);
  /// Power per exitance and area, such that the lamps of all channels emit about `power` units.
  void emit_power(double power);

  /// B of one channel by a dense solve of the same integer factors, each row divided by its sum
  /// where that is above 1, or always in a closed room.
  Eigen::VectorXd exact(int channel) const;

 private:
  int each() const { return scene_.patch_count / scene_.surface_count; }
  double area(int i) const;
  const urad_material& material_of(int i) const { return material_[std::size_t(i / each())]; }
  static urad_status fill(void* room, std::uint16_t shooter, std::uint16_t surface,
                          std::uint16_t first, std::uint16_t count, std::uint32_t* f_uq32);

  std::vector<urad_polygon> polygon_;
  std::vector<urad_surface> surface_;
  std::vector<urad_material> material_;
  std::vector<std::uint32_t> factor_;  ///< [shooter][receiver], UQ0.32; empty: 1 / patches each
  urad_scene scene_{};
};

}  // namespace host
