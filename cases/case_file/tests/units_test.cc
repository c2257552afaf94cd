#include <cases/case_file/case_file.h>
#include <cases/case_file/tests/sample_case.h>
#include <cases/case_file/value_units.h>

#include <gtest/gtest.h>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  std::string about(const std::string &text)
  {
    return complaint(text);
  }

  void expect_piece(const std::string &text, const std::string &piece)
  {
    EXPECT_NE(text.find(piece), std::string::npos) << text;
  }

  std::string slab_with(const std::string &old_piece, const std::string &new_piece)
  {
    return replaced(slab, old_piece, new_piece);
  }
} // namespace

TEST(Units, NumbersArePutIntoSi)
{
  EXPECT_EQ(without_units("2 mm").text, "0.002");
  EXPECT_EQ(without_units("2mm").text, "0.002");
  EXPECT_EQ(without_units("-1.5e1 cm, 3, 2 km").text, "-0.14999999999999999, 3, 2000");
  EXPECT_EQ(without_units("3 h").text, "10800");
  EXPECT_EQ(without_units("0.24 W/(m K)").unit, "W/(m K)");
  // Expressions, tables and words stay as they are.
  for(const char *text : {"0.5*x", "max(1, 2*t)", "-30: 2.5, 0: 2.2", "exact", "1e3", "",
                          "4 x", "if(t<1, 2, 3)"})
  {
    EXPECT_EQ(without_units(text).text, text);
    EXPECT_EQ(without_units(text).unit, "");
  }
}

TEST(Units, AreHeldAgainstTheKeys)
{
  EXPECT_EQ(in_units_of("5 kW", "W or W/m").text, "5000");
  EXPECT_EQ(in_units_of("5 kW/m", "W or W/m").text, "5000");
  EXPECT_EQ(in_units_of("-5 degC", "K or degrees Celsius").text, "-5");
  EXPECT_THROW(in_units_of("5 s", "m"), InputError);
  EXPECT_THROW(in_units_of("5 furlongs", "m"), InputError);
  EXPECT_THROW(in_units_of("5 m", ""), InputError);
}

TEST(Units, ACaseMayHaveThemAnywhere)
{
  const Scene plain = read(slab).scene;
  std::string text = slab_with("end time = 100", "end time = 100000 ms");
  text = replaced(text, "length = 0.1", "length = 10 cm");
  text = replaced(text, "latent heat = 333500", "latent heat = 333.5 kJ/kg");
  text = replaced(text, "conductivity = 2.2", "conductivity = 2200 mW/(m K)");
  text = replaced(text, "capacity = 2090", "capacity = 2.09 kJ/(kg K)");
  text = replaced(text, "density = 1000", "density = 1 g/cm^3");
  text = replaced(text, "set temperature = -10", "set temperature = -10 degC");
  const Scene scene = read(text).scene;
  EXPECT_DOUBLE_EQ(scene.end_time, plain.end_time);
  EXPECT_DOUBLE_EQ(scene.domain.upper[0], plain.domain.upper[0]);
  EXPECT_DOUBLE_EQ(scene.material.latent_heat, plain.material.latent_heat);
  EXPECT_DOUBLE_EQ(scene.material.solid.conductivity, plain.material.solid.conductivity);
  EXPECT_DOUBLE_EQ(scene.material.solid.specific_heat_capacity,
                   plain.material.solid.specific_heat_capacity);
  EXPECT_DOUBLE_EQ(scene.material.solid.density, plain.material.solid.density);
}

TEST(Units, MistakesAreNamedWithWhatWouldBeRight)
{
  const std::string wrong = about(slab_with("length = 0.1", "length = 10 s"));
  expect_piece(wrong, ":7: key 'length'");
  expect_piece(wrong, "a unit of something else");
  expect_piece(wrong, "cm");
  expect_piece(about(slab_with("length = 0.1", "length = 10 yards")),
               "no unit that is known");
  const std::string scales
      = replaced(slab_with("melting temperature = 0", "melting temperature = 273.15 K"),
                 "set temperature = -10", "set temperature = -10 degC");
  expect_piece(about(scales), "a scene has one scale");
  expect_piece(about(replaced("set units = normalised\n" + slab, "length = 0.1",
                              "length = 10 cm")),
               "'normalised', but key 'length' in subsection 'Scene/Domain' (cm)");
}
