#include "network/quantise.hpp"

#include "network/net_rounding.hpp"

namespace host {

TrainingSet with_word_of(const FloatNet& net, TrainingSet set) {
  for (Sample& sample : set.samples)
    sample.target = sample.gate() * net.run(sample.input_q15.data());
  return set;
}

QuantisedNet quantise(const FloatNet& net, int weight_bits, double far_rho,
                      const Compensation& compensation) {
  if (weight_bits == 8 && compensation.training != nullptr)
    return QuantisedNet(narrow_net(net, far_rho, compensation));
  return QuantisedNet(round_net(net, weight_bits, far_rho));
}

QuantisedNet with_near_rho(const QuantisedNet& net, double near_rho) {
  NetTables tables = net.tables();
  tables.near_rho_uq16 = threshold_uq16(near_rho, "near");
  return QuantisedNet(tables);
}

}  // namespace host
