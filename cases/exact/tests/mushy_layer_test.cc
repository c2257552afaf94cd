#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/tests/materials.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace meltfront::cases
{
  namespace
  {
    using similarity::HeatOfFreezing;

    /** Water with sodium nitrate (Monaghan, Huppert and Worster 2005, section 5). */
    Material salt_water()
    {
      return {{2.408, 2006, 1097}, {0.498, 4180, 1097}, 334400, 0};
    }

    constexpr double diffusivity = 6.8e-7 / 1097;

    Alloy sodium_nitrate(double crystal_density, double diffusivity = 0)
    {
      Alloy alloy;
      alloy.solutes.push_back({.name = "sodium nitrate",
                               .liquidus_slope = 42.28,
                               .diffusivity = diffusivity});
      alloy.crystal_density = crystal_density;
      return alloy;
    }

    /** The sets of data: constant or consistent heat of freezing, crystals of 917 kg/m^3
     * or of the liquid's density. */
    MushyLayer set(char name, double diffusivity = 0)
    {
      const bool constant = name == 'A' || name == 'C';
      return MushyLayer(salt_water(), sodium_nitrate(name < 'C' ? 917 : 0, diffusivity),
                        {0.14}, -16.5, 14.7,
                        constant ? HeatOfFreezing::constant : HeatOfFreezing::consistent);
    }

    struct Row
    {
      double y, temperature;
    };

    void expect_profile(const MushyLayer &layer, double time,
                        const std::vector<Row> &rows)
    {
      for(const Row &row : rows)
        EXPECT_NEAR(layer.temperature(row.y, time), row.temperature, 6e-8)
            << row.y << " " << time;
    }

    /** Error of a thrown InputError, or what came instead. */
    template <typename Make>
    std::string complaint(const Make &make)
    {
      try
      {
        make();
      }
      catch(const InputError &error)
      {
        return error.what();
      }
      return "no complaint";
    }
  } // namespace

  TEST(MushyLayer, FrontConstants)
  {
    EXPECT_NEAR(set('A').lambda(), 0.467177889003, 1e-12);
    EXPECT_NEAR(set('B').lambda(), 0.472731880944, 1e-12);
    EXPECT_NEAR(set('C').lambda(), 0.437252447737, 1e-12);
    EXPECT_NEAR(set('D').lambda(), 0.442347427826, 1e-12);
    EXPECT_NEAR(set('A').front(13200), 0.035377119, 1e-9);
    EXPECT_NEAR(set('A').front(91800), 0.093294670, 1e-9);
    EXPECT_NEAR(set('B').front(13200), 0.035797696, 1e-9);
    EXPECT_NEAR(set('B').front(91800), 0.094403793, 1e-9);
    EXPECT_NEAR(set('D').front(91800), 0.088336067, 1e-9);
    Alloy alloy;
    alloy.solutes.push_back({.name = "a", .liquidus_slope = 4});
    const MushyLayer unit({{1, 1, 1}, {1, 1, 1}, 5, 0}, alloy, {0.25}, -3, 0);
    EXPECT_NEAR(unit.lambda(), 0.512191933035, 1e-12);
    EXPECT_NEAR(unit.temperature(unit.front(1) / 2, 1), -1.8131443499, 1e-10);
  }

  TEST(MushyLayer, Profiles)
  {
    const MushyLayer a = set('A');
    expect_profile(a, 13200,
                   {{.01, -13.9086653},
                    {.02, -11.1158437},
                    {.03, -7.9955697},
                    {.05, 0.4996150},
                    {.08, 9.2226292},
                    {.10, 12.1946592},
                    {.15, 14.4937697}});
    expect_profile(a, 91800,
                   {{.01, -15.5377737},
                    {.02, -14.5510627},
                    {.03, -13.5377352},
                    {.05, -11.4179702},
                    {.08, -7.8805269},
                    {.10, -4.7044923},
                    {.12, -1.3245341},
                    {.15, 3.0242914},
                    {.20, 8.3509387},
                    {.30, 13.3373188}});
    expect_profile(
        set('B'), 13200,
        {{.01, -13.9501373}, {.02, -11.2024044}, {.03, -8.1325002}, {.05, 0.3579717}});
    expect_profile(set('B'), 91800,
                   {{.02, -14.5821358},
                    {.05, -11.4996983},
                    {.08, -8.0194987},
                    {.10, -4.8980446},
                    {.15, 2.9078308},
                    {.20, 8.2876093}});
    const double expansion = 1097. / 917;
    EXPECT_NEAR(a.solid_fraction(.02, 13200) * expansion, 0.5592652, 6e-8);
    EXPECT_NEAR(a.solid_fraction(.08, 91800) * expansion, 0.2977365, 6e-8);
    EXPECT_EQ(a.solid_fraction(.10, 91800), 0);
    EXPECT_EQ(a.concentration(.05, 91800), 0.14);
    EXPECT_NEAR(0.14 / (1 - a.solid_fraction(.05, 91800)), 0.2700561, 6e-8);
    EXPECT_EQ(a.temperature(0, 91800), -16.5);
    EXPECT_NEAR(a.temperature(1e-12, 91800), -16.5, 1e-9);
    EXPECT_EQ(a.temperature(.3, 0), 14.7);
  }
} // namespace meltfront::cases
