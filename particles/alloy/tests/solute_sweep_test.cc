#include <particles/alloy/solute_diffusion.h>
#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/tests/scenes.h>
#include <particles/sph_mixture/mixture_conduction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    /** Brine in one or two dimensions, cold walls beside closed ones. */
    cases::Scene cornered_brine(int dimension)
    {
      cases::Scene scene = nitrate_slab(1, 6.2e-10);
      scene.boundaries[1] = cases::Boundary{};
      if(dimension == 2)
      {
        scene.domain.shape = cases::DomainShape::box;
        scene.domain.dimension = 2;
        scene.domain.upper = {0.5, 0.5, 0};
        scene.boundaries[2] = cases::Boundary{};
        scene.boundaries[3] = fixed_wall(-10);
      }
      return scene;
    }

    /** Particles with random states, and what flows between them. */
    struct Brine
    {
      Brine(const cases::Scene &scene, int n, MeanConductivity mean, bool uniform,
            int dimension)
        : scene(scene)
        , substance(scene, "test")
        , resolution(with_options(n))
        , parameters(resolve_mixture_parameters(scene, resolution))
        , dis(scene, parameters.sph)
        , rows(dis, true)
        , size(rows.rows.padded_rows())
        , enthalpy(size)
        , content(size)
        , conduction(substance, mean, uniform, dis.particles.size(), size)
        , diffusion(dis, parameters.sph, substance, rows.rows)
        , dimension(dimension)
      {
        std::mt19937_64 random(11);
        std::uniform_real_distribution<double> of_enthalpy(20000, 400000),
            of_content(0.01, 0.3);
        for(std::size_t a = 0; a < dis.particles.size(); ++a)
        {
          enthalpy[a] = of_enthalpy(random);
          content[a] = uniform ? 0.14 : of_content(random);
        }
        const std::vector<std::span<const double>> composition{content};
        conduction.follow(enthalpy, composition, 1);
        diffusion.follow(conduction.liquid_fraction(), conduction.depressions(),
                         composition);
      }

      static cases::Resolution with_options(int n)
      {
        cases::Resolution resolution;
        resolution.n = n;
        resolution.options = cases::Options(cases::options_of(MixtureParameters()));
        return resolution;
      }

      std::pair<std::vector<double>, std::vector<double>> sweep(int threads)
      {
        std::vector<double> heat(size), solute(size);
        conduction.with_pair(
            [&](const auto &pair)
            { diffusion.flow_with_heat(pair, heat, 0, rows.rows, solute, threads); });
        return {particles_of(heat), particles_of(solute)};
      }

      /** Without the padding, where means of conductivities are not numbers. */
      std::vector<double> particles_of(const std::vector<double> &values) const
      {
        return {values.begin(), values.begin() + dis.particles.size()};
      }

      /** A coordinate and its mirror images in both walls. */
      std::array<double, 3> images(std::size_t b, int direction) const
      {
        const double x = dis.particles.position[direction][b];
        return {x, 2 * scene.domain.lower[direction] - x,
                2 * scene.domain.upper[direction] - x};
      }

      /** Sum over the images of one particle of what they exchange with another. */
      double closed_coefficient(std::size_t a, std::size_t b) const
      {
        const auto own = dis.particles.point(a);
        double sum = 0;
        for(const double x : images(b, 0))
          for(int i = 0; i < (dimension == 2 ? 3 : 1); ++i)
          {
            const double y = dimension == 2 ? images(b, 1)[i] : 0.;
            const double distance
                = std::hypot(own[0] - x, dimension == 2 ? own[1] - y : 0.);
            if(distance > 0 && distance < dis.kernel.support() * (1 - 1e-9))
              sum -= dis.kernel.radial_derivative_over_distance(distance);
          }
        return 2 * dis.particle_volume * dis.particle_volume * sum / rows.second_moment;
      }

      /** Every particle with every other and its images. */
      double brute_force(std::size_t a) const
      {
        const auto liquid = conduction.liquid_fraction();
        double sum = 0;
        for(std::size_t b = 0; b < dis.particles.size(); ++b)
        {
          if(a == b || liquid[a] == 0 || liquid[b] == 0)
            continue;
          const double mean = 2 * liquid[a] * liquid[b] / (liquid[a] + liquid[b]);
          sum += closed_coefficient(a, b) * substance.density
                 * substance.alloy.solutes[0].diffusivity * mean
                 * (content[b] / liquid[b] - content[a] / liquid[a]);
        }
        return sum;
      }

      cases::Scene scene;
      AlloySubstance substance;
      cases::Resolution resolution;
      MixtureParameters parameters;
      Discretisation dis;
      ConductionRows rows;
      std::size_t size;
      std::vector<double> enthalpy, content;
      MixtureConduction conduction;
      SoluteDiffusion diffusion;
      int dimension;
    };

    struct Form
    {
      MeanConductivity mean;
      bool uniform, one_conductivity;
      ConductionForm form;
    };

    constexpr Form forms[]
        = {{MeanConductivity::integral, false, true, ConductionForm::uniform},
           {MeanConductivity::integral, true, false, ConductionForm::transformed},
           {MeanConductivity::integral, false, false, ConductionForm::integral},
           {MeanConductivity::arithmetic, false, false, ConductionForm::arithmetic},
           {MeanConductivity::harmonic, false, false, ConductionForm::harmonic}};

    double largest(const std::vector<double> &values)
    {
      double result = 0;
      for(const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }

    // The sweep over the rows of the heat, corrected next to cold walls, against the sum
    // over all particles and their images beyond walls that are all closed.
    TEST(SoluteSweep, IsTheSumOverAllParticlesAndTheirMirrorImages)
    {
      for(const int dimension : {1, 2})
        for(const Form &form : forms)
        {
          cases::Scene scene = cornered_brine(dimension);
          if(form.one_conductivity)
            scene.material.solid.conductivity = scene.material.liquid.conductivity;
          Brine brine(scene, dimension == 1 ? 50 : 14, form.mean, form.uniform,
                      dimension);
          ASSERT_EQ(brine.conduction.form(), form.form);
          const auto [heat, solute] = brine.sweep(1);
          const double scale = largest(solute);
          ASSERT_GT(scale, 0);
          for(std::size_t a = 0; a < brine.dis.particles.size(); ++a)
            EXPECT_NEAR(solute[a], brine.brute_force(a), 1e-13 * scale) << a;
          EXPECT_NEAR(std::accumulate(solute.begin(), solute.end(), 0.), 0,
                      1e-14 * scale);
        }
    }

    TEST(SoluteSweep, HasTheBitsOfHeatAloneAndOfSoluteAlone)
    {
      for(const Form &form : forms)
      {
        cases::Scene scene = cornered_brine(1);
        if(form.one_conductivity)
          scene.material.solid.conductivity = scene.material.liquid.conductivity;
        Brine brine(scene, 3001, form.mean, form.uniform, 1);
        const auto joint = brine.sweep(1);
        EXPECT_EQ(joint, brine.sweep(2));
        std::vector<double> heat(brine.size), solute(brine.size);
        brine.conduction.conduct(brine.rows.rows, heat, 1);
        brine.diffusion.flow(0, brine.rows.rows, solute, 1);
        EXPECT_EQ(joint.first, brine.particles_of(heat));
        EXPECT_EQ(joint.second, brine.particles_of(solute));
      }
    }

    // Two solutes of the same diffusivity flow as one, the second in a sweep of its own.
    TEST(SoluteSweep, OfTwoSolutesIsThatOfTheirSum)
    {
      cases::Scene one = nitrate_slab(5000, 6.2e-10);
      cases::Scene two = one;
      two.alloy->solutes.push_back(two.alloy->solutes[0]);
      two.initial.concentration
          = {cases::Field::uniform(0.04), cases::Field::uniform(0.10)};
      const auto of_one = run(*make_sph_mixture(), one, 40);
      const auto of_two = run(*make_sph_mixture(), two, 40);
      EXPECT_LT(of_two.solute_defect, 1e-12);
      // Three exchanges of each pair in place of two.
      EXPECT_NEAR(double(of_two.cost.work) / of_one.cost.work, 1.5, 0.03);
      for(std::size_t a = 0; a < of_one.x.size(); ++a)
      {
        EXPECT_NEAR(of_two.temperature[a], of_one.temperature[a], 1e-8);
        EXPECT_NEAR(of_two.concentration[1][a], 0.10 / 0.14 * of_one.concentration[0][a],
                    1e-11);
      }
    }
  } // namespace
} // namespace meltfront::particles::testing
