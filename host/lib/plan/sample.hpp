// A few rows of a scene by any method of the engine: what they cost, and how far the light they carry
// is from the reference's.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "method/engine_source.hpp"
#include "plan/rehearsal.hpp"
#include "plan/work.hpp"
#include "scene/scene.hpp"

namespace host {

/// What a method did in the sampled rows.
struct SampledMethod {
  RowWork work{};    ///< mean over shooters as they come up in a solve
  double error = 0;  ///< of the light of one bounce: relative rms against the reference, see Sample
};

/// Rows of the reference for two sets of patches: receivers, evenly over all that reflect, and
/// shooters, evenly over the shots of a rehearsal.
///
/// Methods whose factors are reciprocal are judged as gatherers: with rho_j sum_i (F_ji - R_ji) B_i,
/// R the reference and B the rehearsal's light, over the light that the receivers reflect. Rows of a
/// hemicube are not reciprocal; their errors arrive from many shooters and are added as independent.
/// In a closed scene rows are first brought to the reference's sum, as repair does.
class Sample {
 public:
  /// `scene` and `fixed` must outlive it. 6 to 24 rows of each set, so that it stays below a second;
  /// what methods count comes from up to four times as many where that is quick.
  Sample(const Scene& scene, const FixedScene& fixed, const Rehearsal& rehearsal, int threads);

  /// exported: the scene with visible parts in flash, to be taken instead of rays; or null.
  SampledMethod run(const MethodSpec& spec, const NetChoice& nets, const EngineOptions& options,
                    const RowSetting& setting, const FixedScene* exported = nullptr) const;
  /// What coarser visible parts make of the light of one bounce, relative rms, by the general
  /// network: no reference is needed, so many receivers are asked. Half a patch seen is all or
  /// nothing in bits; in a few rows of the sample that hardly shows.
  double coarser_error(const NetChoice& nets, const FixedScene& coarse,
                       const FixedScene& fine) const;
  /// The work of a pose table, which has no error here: `block_of` as in a urad_pose_table.
  RowWork table_work(const std::vector<std::uint16_t>& block_of) const;

 private:
  double gathered_error(const EngineSource& source) const;
  double shot_error(const EngineSource& source) const;

  const Scene& scene_;
  const FixedScene& fixed_;
  std::vector<double> light_;
  std::vector<std::size_t> reflecting_;
  std::vector<std::size_t> receivers_, shooters_;
  std::vector<std::size_t> more_shooters_;  ///< for methods whose near pairs are few and dear
  std::vector<double> chance_;              ///< share of all shots, by sampled shooter
  Eigen::MatrixXd from_receivers_, from_shooters_;  ///< reference rows
};

}  // namespace host
