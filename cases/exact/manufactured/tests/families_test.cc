// Level sets, their derivatives and the solid's volumes.

#include <cases/error.h>
#include <cases/exact/manufactured/tests/fifty_digits.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

namespace meltfront::cases::manufactured
{
  namespace
  {
    /** All differences are measured by the largest number of their kind. */
    template <int dim, typename Oracle>
    void check_derivatives(const FrontFamily &family, const Oracle &oracle,
                           const Position &p, double time, double tolerance)
    {
      const auto x = in_fifty_digits<dim>(p);
      const FrontDerivatives f = family.derivatives(p, time),
                             second = family.second_derivatives(p, time);
      const auto expect = [&](double value, std::vector<std::vector<int>> sum)
      {
        Real exact = 0;
        for(const auto &along : sum)
          exact += oracle.derivative(along, x, time);
        EXPECT_NEAR(value, static_cast<double>(exact), tolerance * (1 + std::abs(value)))
            << family.description();
      };
      const auto laplacian = [](std::vector<int> more)
      {
        std::vector<std::vector<int>> sum;
        for(int i = 0; i < dim; ++i)
        {
          sum.push_back(more);
          sum.back().insert(sum.back().end(), {i, i});
        }
        return sum;
      };
      expect(f.value, {{}});
      expect(second.value, {{}});
      expect(family.level_set(p, time), {{}});
      expect(f.rate, {{3}});
      expect(f.acceleration, {{3, 3}});
      expect(f.laplacian, laplacian({}));
      expect(second.laplacian, laplacian({}));
      expect(f.laplacian_rate, laplacian({3}));
      for(int i = 0; i < dim; ++i)
      {
        expect(f.gradient[i], {{i}});
        expect(second.gradient[i], {{i}});
        expect(f.gradient_rate[i], {{i, 3}});
        expect(f.laplacian_gradient[i], laplacian({i}));
        for(int j = 0; j < dim; ++j)
        {
          expect(f.hessian[i][j], {{i, j}});
          expect(second.hessian[i][j], {{i, j}});
        }
      }
    }
  } // namespace

  TEST(FrontFamilies, DerivativesAgreeWithFiftyDigits)
  {
    for(const int power : {2, 3, 5})
      for_each_family(
          [&](const char *name, const auto &formula, auto dim)
          {
            using Formula = std::decay_t<decltype(formula)>;
            const auto family
                = make_front_family({name, dim, period, length_scale, power});
            if(power != 3 && !family->merges())
              return;
            const Differences<Formula, dim> oracle(formula);
            RandomPlace random(*family);
            const bool star = std::is_same_v<Formula, Star>;
            for(int n = 0; n < 40; ++n)
            {
              const Position p = random();
              check_derivatives<dim>(*family, oracle, p, 2 * period * random.share(),
                                     star ? 1e-11 : 1e-12);
            }
          },
          power);
  }

  TEST(FrontFamilies, OneDimensionIsThatOfAPlane)
  {
    const auto slab = make_front_family({"plane", 1, 2, 0.5});
    const auto plane = make_front_family({"plane", 2, 2, 0.5});
    EXPECT_EQ(slab->level_set({0.3, 0, 0}, 0.7), plane->level_set({0.3, 9, 9}, 0.7));
    EXPECT_EQ(slab->solid_volume(0.7), 2 * plane->solid_volume(0.7));
    EXPECT_EQ(slab->domain().second, (Position{0.5, 0, 0}));
    EXPECT_EQ(plane->domain().second, (Position{0.5, 0.5, 0}));
  }

  TEST(FrontFamilies, SolidVolumesAreThoseOfThirtyDigits)
  {
    struct Row
    {
      const char *name;
      int dimension;
      std::array<double, 5> volumes;
    };
    const std::array<double, 5> times{0, 0.15, 0.35, 0.5, 0.6};
    const std::vector<Row> rows{
        {"plane",
         2,
         {0.5, 0.6618033988749895, 0.6618033988749895, 0.5, 0.3824429495415054}},
        {"disk",
         2,
         {0.7853981633974483, 1.212902919766809, 1.212902919766809, 0.7853981633974483,
          0.5328322440839342}},
        {"disk",
         3,
         {0.5235987755982989, 1.004853761434874, 1.004853761434874, 0.5235987755982989,
          0.2925833090522682}},
        {"star-3",
         2,
         {0.7896650880425246, 1.065879778881166, 1.065879778881166, 0.7896650880425246,
          0.6149165939613272}},
        {"star-5",
         2,
         {0.7882043072629472, 1.063908035773985, 1.063908035773985, 0.7882043072629472,
          0.6137790758475043}},
        {"ellipse",
         2,
         {0.3141592653589793, 0.3578431112071454, 0.4200466457482233, 0.4696681017116741,
          0.50416278904809}},
        {"ellipse",
         3,
         {0.1256637061435917, 0.1474313618173439, 0.1797799643802396, 0.2066539647531366,
          0.2258649294935443}},
        {"two-disks",
         2,
         {0.2118032711984948, 0.4224932505594964, 0.5763579541086418, 0.7723155119091932,
          0.6661864965921679}},
        {"two-disks",
         3,
         {0.04982419526267758, 0.1315792852392957, 0.1957931420167538, 0.3266733555136769,
          0.2504094632001868}},
        {"finger",
         2,
         {0.5661201696857436, 0.48998119547278, 0.4369149732568146, 0.3586514415742725,
          0.402524327174293}},
        {"finger",
         3,
         {0.2721301665389898, 0.235412110585028, 0.2177558049277834, 0.1898080883067826,
          0.2055060863035063}}};
    for(const Row &row : rows)
    {
      const auto family = make_front_family({row.name, row.dimension, 1, 1, 3});
      const auto scaled
          = make_front_family({row.name, row.dimension, period, length_scale, 3});
      for(std::size_t n = 0; n < times.size(); ++n)
      {
        SCOPED_TRACE(family->description());
        expect_relative(family->solid_volume(times[n]), row.volumes[n], 1e-12);
        expect_relative(scaled->solid_volume(period * times[n])
                            / std::pow(length_scale, row.dimension),
                        row.volumes[n], 1e-12);
      }
    }
    const auto at_contact = [](const char *name, int dimension) {
      return make_front_family({name, dimension, 1, 1, 3})->solid_volume(0.25);
    };
    expect_relative(at_contact("two-disks", 2), 0.5, 1e-12);
    expect_relative(at_contact("two-disks", 3), 0.1609944758328198, 1e-12);
    expect_relative(at_contact("finger", 2), 0.4635290039756342, 1e-12);
    expect_relative(at_contact("finger", 3), 0.2261946710584651, 1e-12);
  }

  /** The trapezoidal rule over the angle: the error falls exponentially. */
  TEST(FrontFamilies, AreaOfAStarIsThatOfItsRays)
  {
    for(const char *name : {"star-3", "star-5"})
    {
      const auto family = make_front_family({name, 2, 1, 1, 3});
      const int rays = 2000;
      double area = 0;
      for(int n = 0; n < rays; ++n)
      {
        const double angle = 2 * std::numbers::pi * n / rays;
        double inside = 0, outside = 1;
        for(int halving = 0; halving < 55; ++halving)
        {
          const double r = (inside + outside) / 2;
          const Position p{r * std::cos(angle), r * std::sin(angle), 0};
          (family->level_set(p, 0.1) < 0 ? inside : outside) = r;
        }
        area += std::numbers::pi / rays * inside * inside;
      }
      expect_relative(family->solid_volume(0.1), area, 1e-12);
    }
  }

  TEST(FrontFamilies, MergesAreAtAQuarterAndThreeQuarters)
  {
    const auto family = make_front_family({"finger", 2, 2, 1, 3});
    EXPECT_EQ(family->merge_times(0, 2), (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(family->merge_times(0.5, 2.5), (std::vector<double>{0.5, 1.5, 2.5}));
    EXPECT_TRUE(family->merge_times(0.6, 1.4).empty());
    EXPECT_EQ(family->saddle(), (Position{0, 0, 0}));
    const auto disk = make_front_family({"disk", 2, 2, 1, 3});
    EXPECT_TRUE(disk->merge_times(0, 2).empty());
    EXPECT_FALSE(disk->saddle());
    // The saddle belongs to the liquid before the two merge and to the solid after it.
    const auto two = make_front_family({"two-disks", 3, 2, 1, 3});
    EXPECT_GT(two->level_set(*two->saddle(), 0.49), 0);
    EXPECT_LT(two->level_set(*two->saddle(), 0.51), 0);
  }

  TEST(FrontFamilies, CurvatureOfRoundFronts)
  {
    for(const int dimension : {2, 3})
    {
      const auto family = make_front_family({"disk", dimension, period, length_scale, 3});
      const auto uniform = family->uniform_curvature(0.7);
      const double radius = -family->signed_distance({0, 0, 0}, 0.7);
      expect_relative(uniform->value, (dimension - 1) / radius, 1e-14);
      const Position on_front{0.6 * radius, 0.8 * radius, 0};
      expect_relative(family->derivatives(on_front, 0.7).curvature(), uniform->value,
                      1e-13);
      const double step = 1e-4;
      expect_relative(uniform->rate,
                      (family->uniform_curvature(0.7 + step)->value
                       - family->uniform_curvature(0.7 - step)->value)
                          / (2 * step),
                      1e-6);
    }
    EXPECT_TRUE(std::isnan(
        make_front_family({"disk", 2, 1, 1, 3})->derivatives({0, 0, 0}, 0).curvature()));
  }

  TEST(FrontFamilies, RefuseWhatTheyAreNot)
  {
    const std::vector<FamilyParameters> wrong{
        {"square", 2, 1, 1, 3},   {"star-3", 3, 1, 1, 3}, {"disk", 1, 1, 1, 3},
        {"plane", 4, 1, 1, 3},    {"disk", 2, 0, 1, 3},   {"disk", 2, 1, -1, 3},
        {"two-disks", 2, 1, 1, 1}};
    for(const FamilyParameters &parameters : wrong)
      EXPECT_THROW(make_front_family(parameters), InputError) << parameters.name;
    for(const std::string &name : front_family_names())
      EXPECT_EQ(make_front_family({name, 2, 1, 1, 3})->name(), name);
  }
} // namespace meltfront::cases::manufactured
