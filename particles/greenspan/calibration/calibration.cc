#include <cases/error.h>
#include <particles/greenspan/calibration/calibration.h>

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Shares of the averages' time that are spent before them. */
    constexpr double bulk_equilibration = 0.8, conduction_relaxation = 0.3;

    /** A liquid is one below this lattice order, a solid above it. */
    constexpr double dividing_order = 0.37;

    /** Bars of one seed, each longer than the one before, before it is given up. */
    constexpr int most_bars = 3;

    /** Runs of one seed. */
    class Member
    {
    public:
      Member(const CalibrationSettings &settings, std::uint64_t seed,
             const std::function<void(const std::string &)> &done)
        : settings(settings)
        , seed(seed)
        , done(done)
      {
      }

      CalibrationMember run()
      {
        hold(solid_states, settings.solid_excess, false);
        hold(liquid_states, settings.liquid_excess, true);
        const double guess = settings.melting_guess;
        const double density = fit(solid_states, &BulkProperties::density, guess, 1)[0];
        result.spacing = spacing(density);
        find_melting_temperature();
        const double melting = result.substance.melting_temperature;
        result.substance.solid = phase(solid_states, melting);
        result.substance.liquid = phase(liquid_states, melting);
        result.substance.latent_heat
            = fit(liquid_states, &BulkProperties::enthalpy, melting, 2)[0]
              - fit(solid_states, &BulkProperties::enthalpy, melting, 2)[0];
        result.spacing = spacing(result.substance.solid.density.at_melting);
        result.substance.solid.conductivity
            = conduct(settings.solid_conduction, false, melting);
        result.substance.liquid.conductivity
            = conduct(settings.liquid_conduction, true, melting);
        return result;
      }

    private:
      static double spacing(double density)
      {
        return std::sqrt(2 / (std::sqrt(3.) * density));
      }

      BulkSettings bulk(double temperature, bool liquid) const
      {
        BulkSettings run;
        run.crystal.force = settings.force;
        run.crystal.columns = run.crystal.rows = settings.bulk_side;
        run.temperature = temperature;
        run.pressure = settings.pressure;
        run.liquid = liquid;
        run.time_step = settings.time_step;
        run.duration = settings.bulk_time;
        run.equilibration = bulk_equilibration * settings.bulk_time;
        run.seed = seed;
        return run;
      }

      void hold(std::vector<BulkProperties> &states, const std::vector<double> &excess,
                bool liquid)
      {
        for(const double each : excess)
        {
          const double temperature = settings.melting_guess + each;
          states.push_back(measure_bulk(bulk(temperature, liquid)));
          const double order = states.back().lattice_order;
          double &extreme = liquid ? result.liquid_order : result.solid_order;
          if(states.size() == 1)
            extreme = order;
          extreme = liquid ? std::max(extreme, order) : std::min(extreme, order);
          if(liquid ? order > dividing_order : order < dividing_order)
            throw cases::NumericalError(
                "greenspan", 0, 0,
                fmt::format("the order of a {} at T = {:.4g}",
                            liquid ? "liquid" : "solid", temperature),
                fmt::format("is {:.2f}: it has changed its phase; the guess {} of the "
                            "melting temperature is too far off",
                            order, settings.melting_guess));
          done(fmt::format("{} at T = {:.4g}", liquid ? "liquid" : "solid", temperature));
        }
      }

      /** Coefficients about a temperature, of that degree at most and with a value to
       * spare where there are more than two. */
      static std::vector<double> fit(const std::vector<BulkProperties> &states,
                                     double BulkProperties::*property, double temperature,
                                     int degree)
      {
        std::vector<double> x, y;
        for(const BulkProperties &state : states)
        {
          x.push_back(state.temperature - temperature);
          y.push_back(state.*property);
        }
        auto result = fit_polynomial(
            x, y, std::min(degree, std::max(1, static_cast<int>(x.size()) - 2)));
        result.resize(degree + 1, 0);
        return result;
      }

      ContinuumPhase phase(const std::vector<BulkProperties> &states,
                           double melting) const
      {
        ContinuumPhase result;
        const auto density = fit(states, &BulkProperties::density, melting, 1);
        const auto enthalpy = fit(states, &BulkProperties::enthalpy, melting, 2);
        result.density = {density[0], density[1]};
        result.heat_capacity = {enthalpy[1], 2 * enthalpy[2]};
        return result;
      }

      void find_melting_temperature()
      {
        CoexistenceSettings run;
        run.bar.force = settings.force;
        run.bar.spacing = result.spacing;
        run.bar.columns = settings.bar_columns;
        run.bar.rows = settings.rows;
        run.bar.pressure = settings.pressure;
        run.bar.time_step = settings.time_step;
        run.bar.equilibration = 4;
        run.bar.seed = seed;
        run.guess = settings.melting_guess;
        run.duration = settings.coexistence_time;
        const Coexistence balance = balance_in_longer_bars(run);
        result.substance.melting_temperature = balance.temperature;
        result.molten_share = balance.front;
        done(fmt::format("coexistence: T = {:.2f}", balance.temperature));
      }

      /** A bar that wholly melts or freezes is made half as long again: the front wanders
       * by as much in either, the latent heat in between grows. */
      static Coexistence balance_in_longer_bars(CoexistenceSettings run)
      {
        for(int bars = 1;; ++bars)
          try
          {
            return measure_coexistence(run);
          }
          catch(const cases::NumericalError &)
          {
            if(bars == most_bars)
              throw;
            run.bar.columns += run.bar.columns / 2;
          }
      }

      LinearProperty conduct(const std::vector<double> &excess, bool liquid,
                             double melting)
      {
        std::vector<double> x, y;
        for(const double each : excess)
        {
          ConductionSettings run;
          run.phase = bulk(settings.melting_guess + each, liquid);
          run.phase.crystal.columns = settings.slab_columns;
          run.phase.crystal.rows = settings.rows;
          run.phase.equilibration /= 2;
          run.phase.duration /= 2;
          run.half_difference = settings.half_difference;
          run.duration = settings.conduction_time;
          run.relaxation = conduction_relaxation * settings.conduction_time;
          const ConductionResult slab = measure_conduction(run);
          x.push_back(slab.temperature - melting);
          y.push_back(slab.conductivity);
          result.largest_imbalance
              = std::max(result.largest_imbalance, std::abs(slab.imbalance));
          done(fmt::format("{} conducts {:.1f} at T = {:.4g}",
                           liquid ? "liquid" : "solid", slab.conductivity,
                           slab.temperature));
        }
        auto line = fit_polynomial(x, y, std::min(1, static_cast<int>(x.size()) - 1));
        line.resize(2, 0);
        return {line[0], line[1]};
      }

      const CalibrationSettings &settings;
      std::uint64_t seed;
      const std::function<void(const std::string &)> &done;
      std::vector<BulkProperties> solid_states, liquid_states;
      CalibrationMember result;
    };

    /** Mean of something over the members. */
    template <typename Property>
    Measured over(const std::vector<CalibrationMember> &members, const Property &property)
    {
      std::vector<double> values;
      for(const CalibrationMember &member : members)
        values.push_back(property(member));
      return measured(values);
    }

    MeasuredPhase measured_phase(const std::vector<CalibrationMember> &members,
                                 ContinuumPhase Substance::*phase)
    {
      const auto mean
          = [&](LinearProperty ContinuumPhase::*property, double LinearProperty::*part)
      {
        return over(members, [&](const CalibrationMember &member)
                    { return member.substance.*phase.*property.*part; });
      };
      constexpr auto value = &LinearProperty::at_melting, slope = &LinearProperty::slope;
      return {mean(&ContinuumPhase::density, value),
              mean(&ContinuumPhase::density, slope),
              mean(&ContinuumPhase::conductivity, value),
              mean(&ContinuumPhase::conductivity, slope),
              mean(&ContinuumPhase::heat_capacity, value),
              mean(&ContinuumPhase::heat_capacity, slope)};
    }

    /** Members of all seeds; those that failed are in `failures` instead.
     * @throws what the first of them did, where fewer than two are left of several */
    std::vector<CalibrationMember> run_members(const CalibrationSettings &settings,
                                               const CalibrationProgress &progress,
                                               std::vector<FailedSeed> &failures)
    {
      std::vector<CalibrationMember> members(settings.members);
      std::vector<std::exception_ptr> thrown(members.size());
      const double runs = static_cast<double>(settings.members)
                          * static_cast<double>(settings.solid_excess.size()
                                                + settings.liquid_excess.size() + 1
                                                + settings.solid_conduction.size()
                                                + settings.liquid_conduction.size());
      double ended = 0;
      const std::function<void(const std::string &)> done = [&](const std::string &what)
      {
#pragma omp critical(meltfront_calibration_progress)
        {
          ++ended;
          if(progress)
            progress(ended / runs, what);
        }
      };
#pragma omp parallel for schedule(dynamic)                                               \
    num_threads(settings.threads) if(settings.threads > 1)
      for(int member = 0; member < settings.members; ++member)
        try
        {
          members[member] = Member(settings, settings.first_seed + member, done).run();
        }
        catch(...)
        {
          thrown[member] = std::current_exception();
        }
      std::vector<CalibrationMember> finished;
      std::exception_ptr first;
      for(std::size_t member = 0; member < members.size(); ++member)
        try
        {
          if(!thrown[member])
            finished.push_back(members[member]);
          else
            std::rethrow_exception(thrown[member]);
        }
        catch(const cases::NumericalError &failure)
        {
          failures.push_back({settings.first_seed + member, failure.what()});
          first = first ? first : thrown[member];
        }
      if(first && finished.size() < 2)
        std::rethrow_exception(first);
      return finished;
    }
  } // namespace

  CalibrationSettings CalibrationSettings::quick(const PairForce &force)
  {
    CalibrationSettings settings;
    settings.force = force;
    // In the law of corresponding states the bond's work is the unit.
    const double scale = force.bond_work() / PairForce::triangle().bond_work();
    settings.pressure *= scale;
    settings.melting_guess *= scale;
    return settings;
  }

  CalibrationSettings CalibrationSettings::full(const PairForce &force)
  {
    CalibrationSettings settings = quick(force);
    settings.solid_excess = {-12, -8, -4, -1};
    settings.liquid_excess = {1, 5, 10, 15};
    settings.liquid_conduction = {8, 12};
    settings.rows = 24;
    settings.bulk_side = 24;
    settings.slab_columns = 128;
    settings.bar_columns = 96;
    settings.bulk_time = 20;
    settings.conduction_time = 80;
    settings.coexistence_time = 60;
    settings.members = 4;
    return settings;
  }

  void CalibrationSettings::validate() const
  {
    const auto require = [](bool holds, const char *what, double value, const char *right)
    {
      if(!holds)
        throw cases::InputError(
            fmt::format("{} of a calibration is {}; it must be {}", what, value, right));
    };
    require(members >= 1, "the number of seeds", members, "one or more");
    require(threads >= 1, "the number of threads", threads, "one or more");
    require(pressure > 0, "the pressure", pressure, "positive, or the melt boils");
    require(melting_guess > 0, "the guessed melting temperature", melting_guess,
            "positive");
    require(solid_excess.size() >= 2, "the number of temperatures of the solid",
            double(solid_excess.size()), "two or more");
    require(liquid_excess.size() >= 2, "the number of temperatures of the liquid",
            double(liquid_excess.size()), "two or more");
    require(!solid_conduction.empty() && !liquid_conduction.empty(),
            "the least number of conducting slabs of a phase", 0, "one or more");
    require(bulk_time > 0 && conduction_time > 0 && coexistence_time > 0,
            "the least time of averages",
            std::min({bulk_time, conduction_time, coexistence_time}), "positive");
  }

  ContinuumMaterial calibrate(const CalibrationSettings &settings,
                              const CalibrationProgress &progress)
  {
    settings.validate();
    ContinuumMaterial material;
    material.settings = settings;
    material.members = run_members(settings, progress, material.failures);
    const auto &members = material.members;
    material.melting_temperature = over(members, [](const auto &member)
                                        { return member.substance.melting_temperature; });
    material.latent_heat
        = over(members, [](const auto &member) { return member.substance.latent_heat; });
    material.spacing = over(members, [](const auto &member) { return member.spacing; });
    material.solid = measured_phase(members, &Substance::solid);
    material.liquid = measured_phase(members, &Substance::liquid);
    return material;
  }

  Substance ContinuumMaterial::substance() const
  {
    const auto phase = [](const MeasuredPhase &measured)
    {
      return ContinuumPhase{
          {measured.density.value, measured.density_slope.value},
          {measured.conductivity.value, measured.conductivity_slope.value},
          {measured.heat_capacity.value, measured.heat_capacity_slope.value}};
    };
    return {melting_temperature.value, latent_heat.value, phase(solid), phase(liquid)};
  }

  Measured ContinuumMaterial::front_slope(double wall_temperature,
                                          double initial_temperature) const
  {
    std::vector<double> slopes;
    for(const CalibrationMember &member : members)
      slopes.push_back(
          melt_half_space(member.substance, wall_temperature, initial_temperature).slope);
    return {melt_half_space(substance(), wall_temperature, initial_temperature).slope,
            measured(slopes).error};
  }

  Measured measured(const std::vector<double> &values)
  {
    const Spread all = spread(values);
    return {all.mean, all.standard_error()};
  }

  std::vector<double> fit_polynomial(const std::vector<double> &x,
                                     const std::vector<double> &y, int degree)
  {
    if(x.size() != y.size() || degree < 0 || static_cast<int>(x.size()) < degree + 1)
      throw cases::InputError(fmt::format(
          "a polynomial of degree {} is to be fitted to {} values at {} places; it needs "
          "as many of both, and more than the degree",
          degree, y.size(), x.size()));
    Eigen::MatrixXd matrix(x.size(), degree + 1);
    Eigen::VectorXd right(y.size());
    for(std::size_t p = 0; p < x.size(); ++p)
    {
      double power = 1;
      for(int c = 0; c <= degree; ++c, power *= x[p])
        matrix(p, c) = power;
      right[p] = y[p];
    }
    const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(right);
    return {solution.begin(), solution.end()};
  }
} // namespace meltfront::particles::greenspan
