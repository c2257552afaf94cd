#include <particles/alloy/tests/alloy_scenes.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace meltfront::particles::testing
{
  using namespace cases;

  Material nitrate_solvent()
  {
    Material material;
    material.solid = {2.408, 2006, nitrate_density};
    material.liquid = {0.498, 4180, nitrate_density};
    material.latent_heat = 334400;
    return material;
  }

  Alloy nitrate()
  {
    Alloy alloy;
    Solute salt;
    salt.name = "sodium nitrate";
    salt.liquidus_slope = nitrate_slope;
    alloy.solutes.push_back(salt);
    alloy.crystal_density = 917;
    return alloy;
  }

  MushyLayer nitrate_layer()
  {
    return {nitrate_solvent(), nitrate_slope * nitrate_concentration,
            nitrate_density / 917, -16.5, 14.7};
  }

  Scene nitrate_slab(double end_time, double diffusivity)
  {
    const auto exact = std::make_shared<MushySimilarity>(nitrate_layer());
    Scene scene
        = slab(nitrate_solvent(), 0.5, 14.7, end_time, fixed_wall(-16.5),
               varying_wall([exact](double t)
                            { return t > 0 ? exact->temperature(0.5, t) : 14.7; }));
    scene.boundaries[1]->exact = true;
    scene.alloy = nitrate();
    scene.alloy->solutes[0].diffusivity = diffusivity;
    scene.initial.concentration = {Field::uniform(nitrate_concentration)};
    return scene;
  }

  namespace
  {
    /** Entropy of heat and of the change of phase (J/K per area), degrees Celsius. */
    double entropy(const Snapshot &s, const Material &m)
    {
      double sum = 0;
      for(std::size_t i = 0; i < s.weights.size(); ++i)
      {
        const double liquid = 1 - s.solid_fraction[i];
        const double capacity = liquid * m.liquid.specific_heat_capacity
                                + s.solid_fraction[i] * m.solid.specific_heat_capacity;
        sum += s.weights[i] * m.solid.density
               * (capacity * std::log((s.temperature[i] + 273.15) / 273.15)
                  + liquid * m.latent_heat / 273.15);
      }
      return sum;
    }

    /** -sum m_l [C ln C + (1 - C) ln(1 - C)] of the first solute in the liquid. */
    double mixing_entropy(const Snapshot &s, const Material &m)
    {
      double sum = 0;
      for(std::size_t i = 0; i < s.concentration[0].size(); ++i)
      {
        const double liquid = 1 - s.solid_fraction[i];
        const double c = s.concentration[0][i] / liquid;
        sum -= s.weights[i] * m.solid.density * liquid
               * (c * std::log(c) + (1 - c) * std::log(1 - c));
      }
      return sum;
    }

    class AlloyWatcher : public Observer
    {
    public:
      AlloyWatcher(const Scene &scene, long every, AlloyOutcome &outcome)
        : scene(scene)
        , every(every)
        , outcome(outcome)
      {
      }

      void begin(const RunDescription &description) override
      {
        outcome.description = description;
      }

      bool wants(long step, double) override
      {
        return step % every == 0;
      }

      void observe(const Snapshot &s) override
      {
        const auto keep = [](std::span<const double> from, std::vector<double> &to)
        { to.assign(from.begin(), from.end()); };
        keep(s.positions[0], outcome.x);
        keep(s.weights, outcome.weights);
        keep(s.temperature, outcome.temperature);
        keep(s.solid_fraction, outcome.solid_fraction);
        outcome.concentration.resize(most_solutes);
        outcome.solid = 0;
        for(std::size_t i = 0; i < s.weights.size(); ++i)
          outcome.solid += s.weights[i] * s.solid_fraction[i];
        for(std::size_t solute = 0; solute < most_solutes; ++solute)
        {
          keep(s.concentration[solute], outcome.concentration[solute]);
          outcome.solute_defect
              = std::max(outcome.solute_defect, s.solute[solute].defect());
        }
        outcome.heat_defect = std::max(outcome.heat_defect, s.heat.defect());
        outcome.mass_defect = std::max(outcome.mass_defect, s.mass.defect());
        const auto [low, high]
            = std::minmax_element(s.temperature.begin(), s.temperature.end());
        const bool first = outcome.times.empty();
        outcome.lowest = first ? *low : std::min(outcome.lowest, *low);
        outcome.highest = first ? *high : std::max(outcome.highest, *high);
        outcome.heat = s.heat;
        outcome.times.push_back(s.time);
        outcome.solids.push_back(outcome.solid);
        outcome.entropies.push_back(entropy(s, scene.material));
        if(!s.concentration[0].empty())
          outcome.mixing_entropies.push_back(mixing_entropy(s, scene.material));
      }

    private:
      const Scene &scene;
      long every;
      AlloyOutcome &outcome;
    };
  } // namespace

  AlloyOutcome run(const Method &method, const Scene &scene, int n,
                   const OptionTexts &options, long every, int threads)
  {
    AlloyOutcome outcome;
    AlloyWatcher watcher(scene, every, outcome);
    outcome.cost
        = solve(method, scene, resolution_of(method, n, options, threads), watcher);
    return outcome;
  }

  MushErrors compare(const AlloyOutcome &outcome, const MushyLayer &layer, double time)
  {
    const MushySimilarity exact(layer);
    MushErrors errors{};
    int rows = 0;
    for(std::size_t i = 0; i < outcome.x.size(); ++i)
    {
      if(outcome.weights[i] == 0)
        continue; // a wall
      ++rows;
      const double t = outcome.temperature[i] - exact.temperature(outcome.x[i], time);
      const double theta
          = layer.expansion
            * (outcome.solid_fraction[i] - exact.solid_fraction(outcome.x[i], time));
      errors.temperature += t * t;
      errors.theta += theta * theta;
      errors.largest = std::max(errors.largest, std::abs(t));
    }
    errors.temperature = std::sqrt(errors.temperature / rows);
    errors.theta = std::sqrt(errors.theta / rows);
    errors.ice = outcome.solid / exact.solid_length(time) - 1;
    return errors;
  }
} // namespace meltfront::particles::testing
