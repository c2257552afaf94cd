// Run on any number of ranks (ctest: on one, two and four): a run that ranks share has
// the bits of the run of one process, whatever it is made of.

#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/shared_run.h>
#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/sph/ranks/rank_particles.h>
#include <particles/sph/sph.h>

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <numeric>
#include <set>

namespace meltfront::particles::tests
{
  namespace
  {
    using namespace cases;
    using namespace test_support;

    int all_ranks()
    {
      int size = 0;
      MPI_Comm_size(MPI_COMM_WORLD, &size);
      return size;
    }

    /** What a run showed after every step: sums of all ranks, and of this rank's sites
     * the numbers and values. */
    struct Shown : Observer
    {
      bool wants(long, double) override
      {
        return true;
      }

      void begin(const RunDescription &run) override
      {
        for(const Parameter &parameter : run.parameters)
          description.push_back(parameter.name + " " + parameter.value);
      }

      void observe(const Snapshot &snapshot) override
      {
        if(run)
        {
          const RankPart part = run->part();
          numbers.assign(part.site_numbers.begin(), part.site_numbers.end());
          EXPECT_EQ(part.n_own_sites, snapshot.weights.size());
        }
        for(const double sum :
            {snapshot.time, snapshot.heat.stored, snapshot.heat.latent,
             snapshot.heat.boundary, snapshot.heat.sources, snapshot.heat.initial})
          sums.push_back(sum);
        worst_defect = std::max(worst_defect, snapshot.heat.defect());
        for(int d = 0; d < snapshot.dimension; ++d)
          place[d].assign(snapshot.positions[d].begin(), snapshot.positions[d].end());
        weights.assign(snapshot.weights.begin(), snapshot.weights.end());
        temperature.emplace_back(snapshot.temperature.begin(),
                                 snapshot.temperature.end());
        solid_fraction.emplace_back(snapshot.solid_fraction.begin(),
                                    snapshot.solid_fraction.end());
      }

      const SharedRun *run = nullptr; ///< of one process: none
      std::vector<std::uint64_t> numbers;
      std::vector<double> sums;
      std::array<std::vector<double>, 3> place;
      std::vector<double> weights;
      std::vector<std::vector<double>> temperature, solid_fraction; ///< by step
      std::vector<std::string> description;
      double worst_defect = 0;
      Cost cost;
    };

    const auto method = make_sph();

    std::unique_ptr<SharedRun> shared_run(const Scene &simulated,
                                          const EffectSet &effects,
                                          const Resolution &resolution)
    {
      return dynamic_cast<const SharedMethod &>(*method).set_up_on_ranks(
          simulated, effects, resolution, all_ranks());
    }

    /** @param ranks all of them share it, or each runs it by itself */
    Shown show(const Scene &scene, int n, const OptionTexts &options, bool ranks)
    {
      const EffectSet effects = effects_called_for(scene);
      const Scene simulated = simulated_scene(scene, effects);
      const Resolution resolution = resolution_of(*method, n, options);
      Shown shown;
      if(!ranks)
      {
        shown.cost = method->solve(simulated, effects, resolution, shown);
        return shown;
      }
      const Stopwatch stopwatch;
      const auto run = shared_run(simulated, effects, resolution);
      shown.run = run.get();
      shown.cost = run->carry_out(simulated, stopwatch, shown);
      return shown;
    }

    /** Every bit, after every step. */
    void expect_same_bits(const Scene &scene, int n, const OptionTexts &options = {})
    {
      const Shown shared = show(scene, n, options, true),
                  alone = show(scene, n, options, false);
      EXPECT_EQ(shared.sums, alone.sums);
      EXPECT_EQ(shared.description, alone.description);
      EXPECT_EQ(shared.cost.steps, alone.cost.steps);
      EXPECT_EQ(shared.cost.unknowns, alone.cost.unknowns);
      EXPECT_EQ(shared.cost.capped_steps, alone.cost.capped_steps);
      EXPECT_LE(shared.worst_defect, 1e-12);
      ASSERT_EQ(shared.temperature.size(), alone.temperature.size());
      ASSERT_GT(shared.numbers.size(), 0u);
      std::size_t different = 0;
      const auto compare
          = [&](const std::vector<double> &own, const std::vector<double> &all)
      {
        for(std::size_t i = 0; i < own.size(); ++i)
          different += own[i] != all[shared.numbers[i]];
      };
      for(std::size_t k = 0; k < alone.temperature.size(); ++k)
      {
        compare(shared.temperature[k], alone.temperature[k]);
        compare(shared.solid_fraction[k], alone.solid_fraction[k]);
      }
      for(int d = 0; d < 3; ++d)
        compare(shared.place[d], alone.place[d]);
      compare(shared.weights, alone.weights);
      EXPECT_EQ(different, 0u);
      EXPECT_EQ(shared.cost.evidence.at("ranks"), all_ranks());
      EXPECT_EQ(shared.cost.evidence.at("bytes sent per step") > 0, all_ranks() > 1);
      // Something happened.
      EXPECT_NE(alone.temperature.front(), alone.temperature.back());
    }

    Scene line_sink_square()
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      Scene scene = box(water(), 2, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, 10, 3e4);
      scene.sources.push_back(steady_sink({0.01, -0.02, 0}, exact->strength()));
      for(const Side side : scene.sides())
        set_boundary(scene, side, exact_wall(exact));
      return scene;
    }

    /** Ice with cold walls of all kinds, of other properties than the water's. */
    Scene walls_of_all_kinds(int dimension)
    {
      Scene scene
          = box(water(), dimension, {0, 0, 0}, {1, 0.5, dimension > 2 ? 0.5 : 0}, 3, 5e4);
      set_boundary(scene, Side::x_min, fixed_wall(-8));
      set_boundary(scene, Side::x_max, flux_wall(-40));
      Boundary convection;
      convection.kind = BoundaryKind::heat_transfer;
      convection.value = Field::uniform(-5);
      convection.heat_transfer_coefficient = 20;
      set_boundary(scene, Side::y_min, convection);
      Boundary radiation;
      radiation.kind = BoundaryKind::radiation;
      radiation.value = Field::uniform(-20);
      radiation.emission_coefficient = 0.9 * 5.670374419e-8;
      radiation.absolute_zero = -273.15;
      set_boundary(scene, Side::y_max, radiation);
      scene.volumetric_source = Field::uniform(30);
      return scene;
    }

    /** Bodies of ice whose fronts touch and go on, in warm water; walls that repeat. */
    Scene fronts_that_meet()
    {
      Material material = unit_material();
      material.liquid = {0.5, 2, 1};
      Scene scene = box(material, 2, {-1, -1, 0}, {1, 1, 0}, 0.3, 0.03);
      scene.initial.front = field_of(
          [](const Position &p) {
            return std::min(std::hypot(p[0] - 0.5, p[1]), std::hypot(p[0] + 0.5, p[1]))
                   - 0.42;
          });
      scene.initial.temperature = field_of(
          [](const Position &p)
          {
            const double depth
                = std::min(std::hypot(p[0] - 0.5, p[1]), std::hypot(p[0] + 0.5, p[1]))
                  - 0.42;
            return depth < 0 ? 2 * depth : 0.05 * depth;
          });
      set_boundary(scene, Side::y_min, periodic_wall());
      set_boundary(scene, Side::y_max, periodic_wall());
      set_boundary(scene, Side::x_min, fixed_wall(-0.5));
      return scene;
    }
  } // namespace

  TEST(RanksOfSph, FrontsAboutASinkWithinExactWalls)
  {
    expect_same_bits(line_sink_square(), 48);
    expect_same_bits(line_sink_square(), 37, {{"front", "sub_particle"}});
  }

  TEST(RanksOfSph, WallsOfAllKindsAndReleasedHeat)
  {
    expect_same_bits(walls_of_all_kinds(2), 40);
    expect_same_bits(walls_of_all_kinds(2), 24,
                     {{"time_scheme", "euler"}, {"smoothing_length", "1.3"}});
  }

  TEST(RanksOfSph, CellsThatAreStretchedToFillABox)
  {
    Scene scene = walls_of_all_kinds(2);
    scene.domain.upper[1] = 0.513;
    expect_same_bits(scene, 40);
  }

  TEST(RanksOfSph, InSpace)
  {
    Scene scene = walls_of_all_kinds(3);
    scene.end_time = 1e4;
    expect_same_bits(scene, 20);
  }

  TEST(RanksOfSph, FrontsThatMeetAcrossPeriodicWalls)
  {
    expect_same_bits(fronts_that_meet(), 40);
  }

  TEST(RanksOfSph, SlabsAsStripsOfAnyDimension)
  {
    const Scene scene = slab(water(), 1, 10, 2e4, fixed_wall(-10), fixed_wall(5));
    for(const char *dimension : {"1", "2", "3"})
      expect_same_bits(scene, 40, {{"dimension", dimension}});
  }

  TEST(RanksOfSph, ConductionAlone)
  {
    Material plain;
    plain.latent_heat = 0;
    Scene scene = box(plain, 2, {0, 0, 0}, {1, 1, 0}, 1, 0.02);
    set_boundary(scene, Side::y_min, fixed_wall(-1));
    expect_same_bits(scene, 40);
    scene.inclusion
        = Inclusion{field_of([](const Position &p)
                             { return std::hypot(p[0] - 0.4, p[1] - 0.45) - 0.2; }),
                    7.};
    expect_same_bits(scene, 40);
  }

  TEST(RanksOfSph, MeltingOverARange)
  {
    const auto line = [](double from, double at_from, double to, double at_to)
    {
      return std::make_shared<PropertyCurve>(std::vector<double>{from, to},
                                             std::vector<double>{at_from, at_to}, "line");
    };
    Material material = unit_material(-0.5);
    material.solid.conductivity_curve = line(-2, 3, -0.5, 1);
    material.liquid.heat_capacity_curve = line(0, 1, 2, 2);
    material.melting_range = std::make_shared<MeltingRange>(
        MeltingRange{-0.5, 0.2, line(-0.5, 0.4, 0.2, 0), "linear"});
    material.update_curves();
    Scene scene = box(material, 2, {0, 0, 0}, {1, 1, 0}, 1, 0.03);
    set_boundary(scene, Side::x_min, fixed_wall(-1.5));
    expect_same_bits(scene, 40);
  }

  TEST(RanksOfSph, RefuseWhatIsForOneProcess)
  {
    const Scene scene = walls_of_all_kinds(2);
    const EffectSet effects = effects_called_for(scene);
    const Scene simulated = simulated_scene(scene, effects);
    const auto refusal = [&](int n, const OptionTexts &options) -> std::string
    {
      try
      {
        shared_run(simulated, effects, resolution_of(*method, n, options));
      }
      catch(const Refusal &refused)
      {
        return refused.what();
      }
      return "";
    };
    const auto expect = [&](const OptionTexts &options, const std::string &taken)
    {
      const std::string said = refusal(20, options);
      EXPECT_NE(said.find("sph on several ranks takes " + taken), std::string::npos)
          << said;
    };
    expect({{"arrangement", "jittered"}, {"jitter", "0.1"}, {"smoothing_length", "1.3"}},
           "particles on a lattice");
    expect({{"time_scheme", "backward-euler"}}, "explicit steps");
    expect({{"step_limit", "stability"}}, "steps that keep the maximum principle");
    expect({{"front", "partner"}}, "fronts within particles");
    EXPECT_EQ(refusal(20, {}), "");
    const Capabilities taken
        = dynamic_cast<const SharedMethod &>(*method).capabilities_on_ranks();
    EXPECT_FALSE(taken.takes(Effect::liquid_motion));
    EXPECT_FALSE(taken.takes(Effect::moving_source));
    for(const ShapeCapability &shape : taken.shapes)
      EXPECT_TRUE(shape.shape == DomainShape::box || shape.shape == DomainShape::slab);
  }

  namespace
  {
    struct Left
    {
    };

    /** Throws after some steps. */
    struct Leaver : Observer
    {
      bool wants(long step, double) override
      {
        if(step == 3)
          throw Left();
        return false;
      }

      void observe(const Snapshot &) override
      {
      }
    };
  } // namespace

  // What ends a run on all ranks leaves nothing behind that the next run would meet.
  TEST(RanksOfSph, RunsMayBeLeftByAll)
  {
    const Scene scene = walls_of_all_kinds(2);
    const EffectSet effects = effects_called_for(scene);
    const Scene simulated = simulated_scene(scene, effects);
    {
      Leaver leaver;
      const auto run = shared_run(simulated, effects, resolution_of(*method, 16, {}));
      EXPECT_THROW(run->carry_out(simulated, Stopwatch(), leaver), Left);
    }
    expect_same_bits(scene, 16);
  }

  namespace
  {
    struct Shares : testing::Test
    {
      Scene scene = box(unit_material(), 2, {0, 0, 0}, {1, 0.75, 0}, 1, 1);
      SphParameters parameters;

      Discretisation whole(int n)
      {
        parameters.dimension = 2;
        parameters.n = n;
        set_boundary(scene, Side::y_min, periodic_wall());
        set_boundary(scene, Side::y_max, periodic_wall());
        return {scene, parameters};
      }
    };
  } // namespace

  TEST_F(Shares, AreOfOneSizeAndLeaveNothingOut)
  {
    for(const int n : {20, 36, 64})
      for(const int ranks : {1, 2, 3, 4, 7})
      {
        const Discretisation all = whole(n);
        std::uint64_t next = 0;
        for(int rank = 0; rank < ranks; ++rank)
        {
          const RankParticles part
              = particles_of_rank(all, {.values = 1, .fronts = 0}, rank, ranks);
          EXPECT_EQ(part.own.first_number, next);
          EXPECT_EQ(part.own.all, all.particles.size());
          EXPECT_LE(
              std::abs(double(part.own.size()) - double(all.particles.size()) / ranks),
              8);
          for(std::size_t i = part.own.begin; i < part.own.end; ++i)
            EXPECT_EQ(part.numbers[i], next++);
          // Whole slices.
          for(std::size_t i = 0; i < part.numbers.size(); ++i)
            EXPECT_EQ(part.numbers[i] % 8, i % 8);
        }
        EXPECT_EQ(next, all.particles.size());
      }
  }

  TEST_F(Shares, HoldAllNeighboursAndNotEverything)
  {
    const Discretisation all = whole(64);
    const NeighbourList neighbours(all.particles, 1.8 * all.spacing, all.periodicity);
    for(int rank = 0; rank < 4; ++rank)
      for(const int cells : {1, 3})
      {
        const RankParticles part
            = particles_of_rank(all, {.values = cells, .fronts = 0}, rank, 4);
        std::set<std::uint32_t> reached(
            part.numbers.begin() + static_cast<std::ptrdiff_t>(part.own.begin),
            part.numbers.begin() + static_cast<std::ptrdiff_t>(part.own.end));
        for(int step = 0; step < cells; ++step)
          for(const std::uint32_t a : std::set<std::uint32_t>(reached))
            reached.insert(neighbours[a].begin(), neighbours[a].end());
        const std::set<std::uint32_t> held(part.numbers.begin(), part.numbers.end());
        EXPECT_TRUE(std::ranges::includes(held, reached));
        EXPECT_LT(held.size(), all.particles.size() / 2);
      }
  }

  TEST_F(Shares, OfTooFewParticlesAreRefused)
  {
    const Discretisation all = whole(8); // 48 particles in 6 slices
    EXPECT_NO_THROW(particles_of_rank(all, {}, 5, 6));
    EXPECT_THROW(particles_of_rank(all, {}, 0, 7), Refusal);
  }
} // namespace meltfront::particles::tests

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  const int status = RUN_ALL_TESTS();
  MPI_Finalize();
  return status;
}
