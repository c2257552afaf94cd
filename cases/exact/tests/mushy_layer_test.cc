// The mushy layer against independently computed digits, and what it refuses.

#include <cases/error.h>
#include <cases/exact/tests/salt_water.h>

namespace meltfront::cases
{
  namespace
  {
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
  } // namespace

  TEST(MushyLayer, FrontConstants)
  {
    EXPECT_NEAR(data_set('A').lambda(), 0.467177889003, 1e-12);
    EXPECT_NEAR(data_set('B').lambda(), 0.472731880944, 1e-12);
    EXPECT_NEAR(data_set('C').lambda(), 0.437252447737, 1e-12);
    EXPECT_NEAR(data_set('D').lambda(), 0.442347427826, 1e-12);
    EXPECT_NEAR(data_set('A').front(13200), 0.035377119, 1e-9);
    EXPECT_NEAR(data_set('A').front(91800), 0.093294670, 1e-9);
    EXPECT_NEAR(data_set('B').front(13200), 0.035797696, 1e-9);
    EXPECT_NEAR(data_set('B').front(91800), 0.094403793, 1e-9);
    EXPECT_NEAR(data_set('D').front(91800), 0.088336067, 1e-9);
    Alloy alloy;
    alloy.solutes.push_back({.name = "a", .liquidus_slope = 4});
    const MushyLayer unit({{1, 1, 1}, {1, 1, 1}, 5, 0}, alloy, {0.25}, -3, 0);
    EXPECT_NEAR(unit.lambda(), 0.512191933035, 1e-12);
    EXPECT_NEAR(unit.temperature(unit.front(1) / 2, 1), -1.8131443499, 1e-10);
  }

  TEST(MushyLayer, Profiles)
  {
    const MushyLayer a = data_set('A');
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
        data_set('B'), 13200,
        {{.01, -13.9501373}, {.02, -11.2024044}, {.03, -8.1325002}, {.05, 0.3579717}});
    expect_profile(data_set('B'), 91800,
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

  TEST(MushyLayer, RefusesWhatItCannotSolve)
  {
    const auto about = [](const Alloy &alloy, const std::vector<double> &concentration,
                          double wall, double far) -> std::string
    {
      try
      {
        MushyLayer(salt_water(), alloy, concentration, wall, far);
      }
      catch(const InputError &error)
      {
        return error.what();
      }
      return "no complaint";
    };
    const Alloy salt = sodium_nitrate(917);
    EXPECT_EQ(about(salt, {0.14}, -5, 14.7),
              "mushy layer: the wall (-5) must be colder than the liquidus (-5.9192)");
    EXPECT_EQ(about(salt, {0.14}, -16.5, -6),
              "mushy layer: the far temperature (-6) must be above the liquidus "
              "(-5.9192)");
    EXPECT_EQ(about(salt, {0}, -16.5, 10),
              "mushy layer: there is no solute: Neumann's solution is that of the pure "
              "substance");
    EXPECT_EQ(about(salt, {1}, -16.5, 10),
              "mushy layer: a concentration must be at least 0 and less than 1, not 1");
    EXPECT_EQ(about(salt, {0.1, 0.1}, -16.5, 10),
              "mushy layer: 1 solute but 2 concentrations");
    EXPECT_EQ(about(salt, {0.14}, std::nan(""), 10),
              "mushy layer: the wall (nan) must be colder than the liquidus (-5.9192)");
    EXPECT_TRUE(about(salt, {0.14}, -160, 10).starts_with("mushy layer: at the wall's "));
    Alloy eutectic = sodium_nitrate(917, salt_diffusivity);
    eutectic.eutectic_temperature = -16;
    EXPECT_EQ(about(eutectic, {0.14}, -16.5, 14.7),
              "mushy layer: where solute diffuses, the wall must not be below the "
              "eutectic temperature");
    Alloy curved = sodium_nitrate(917, salt_diffusivity);
    curved.solutes[0].liquidus_curve = [](double c) { return 40 * c; };
    EXPECT_TRUE(
        about(curved, {0.14}, -16.5, 14.7).starts_with("mushy layer: a curved liquidus"));
    Alloy unequal = sodium_nitrate(917, salt_diffusivity);
    unequal.solutes.push_back({.name = "second", .liquidus_slope = 30});
    EXPECT_TRUE(about(unequal, {0.14, 0.1}, -16.5, 14.7)
                    .starts_with("mushy layer: both solutes must diffuse equally"));
  }
} // namespace meltfront::cases
