#include <cases/error.h>
#include <particles/greenspan/calibration/calibration.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    CalibrationSettings tiny(int members)
    {
      CalibrationSettings settings = CalibrationSettings::quick(PairForce::triangle());
      settings.bulk_side = 12;
      settings.slab_columns = 32;
      settings.rows = 8;
      settings.bar_columns = 48;
      settings.bulk_time = 4;
      settings.conduction_time = 6;
      settings.coexistence_time = 5;
      settings.members = members;
      return settings;
    }

    BulkProperties solid_at(double temperature)
    {
      BulkSettings settings;
      settings.crystal.columns = settings.crystal.rows = 16;
      settings.temperature = temperature;
      settings.pressure = 3;
      settings.equilibration = 4;
      settings.duration = 8;
      return measure_bulk(settings);
    }

    // Oracle: runs of LAMMPS, one each, good to some 10 % (density: 1 %).
    TEST(GreenspanCalibration, SolidIsThatOfAnIndependentCode)
    {
      const BulkProperties warm = solid_at(38), cool = solid_at(26);
      EXPECT_NEAR(warm.density, 0.922 + 0.005, 0.01); // 0.922 at 40.5
      const double heat_capacity
          = (warm.enthalpy - cool.enthalpy) / (warm.temperature - cool.temperature);
      EXPECT_NEAR(heat_capacity, 1.87 + 0.0137 * 32, 0.25);
      EXPECT_GT(warm.lattice_order, 0.7);
      EXPECT_NEAR(warm.pressure, 3, 3);
      EXPECT_NEAR(warm.temperature, 38, 2);
    }

    TEST(GreenspanCalibration, MeasuresASubstance)
    {
      CalibrationSettings side_by_side = tiny(2);
      side_by_side.threads = 2;
      double share = 0;
      int calls = 0;
      const ContinuumMaterial material
          = calibrate(side_by_side,
                      [&](double done, const std::string &what)
                      {
                        EXPECT_GT(done, share);
                        EXPECT_FALSE(what.empty());
                        share = done;
                        ++calls;
                      });
      EXPECT_DOUBLE_EQ(share, 1);
      EXPECT_EQ(calls, 16);
      EXPECT_NEAR(material.melting_temperature.value, 45, 3);
      EXPECT_GT(material.melting_temperature.error, 0);
      EXPECT_NEAR(material.latent_heat.value, 29, 12);
      EXPECT_GT(material.solid.density.value, material.liquid.density.value);
      EXPECT_GT(material.solid.conductivity.value, material.liquid.conductivity.value);
      EXPECT_GT(material.liquid.conductivity.value, 0);
      EXPECT_GT(material.liquid.heat_capacity.value, material.solid.heat_capacity.value);
      EXPECT_GT(material.solid.heat_capacity.value, 1.5);
      for(const CalibrationMember &member : material.members)
      {
        EXPECT_LT(member.liquid_order, 0.37);
        EXPECT_GT(member.solid_order, 0.6);
      }
      const Measured slope = material.front_slope(60, 42);
      EXPECT_GT(slope.value, 2);
      EXPECT_GT(slope.error, 0);
      // The first seed alone has the same bits.
      const CalibrationMember alone = calibrate(tiny(1)).members[0];
      EXPECT_EQ(alone.substance.melting_temperature,
                material.members[0].substance.melting_temperature);
      EXPECT_EQ(alone.substance.solid.conductivity.at_melting,
                material.members[0].substance.solid.conductivity.at_melting);
    }

    TEST(GreenspanCalibration, BadInputIsRefused)
    {
      CalibrationSettings boiling = tiny(1);
      boiling.pressure = 0;
      EXPECT_THROW(calibrate(boiling), cases::InputError);
      CalibrationSettings nobody = tiny(0);
      EXPECT_THROW(calibrate(nobody), cases::InputError);
      CalibrationSettings one_point = tiny(1);
      one_point.liquid_excess = {3};
      EXPECT_THROW(calibrate(one_point), cases::InputError);
      CalibrationSettings wrong = tiny(1);
      wrong.melting_guess = 90; // nothing is solid there
      EXPECT_THROW(calibrate(wrong), cases::NumericalError);
      ConductionSettings slab;
      slab.bins = 5;
      EXPECT_THROW(measure_conduction(slab), cases::InputError);
      CoexistenceSettings nowhere;
      nowhere.guess = -1;
      EXPECT_THROW(measure_coexistence(nowhere), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
