#include <cases/error.h>
#include <verification/plugins/plugins.h>
#include <verification/record/hash.h>
#include <verification/record/provenance.h>
#include <verification/record/temporary_directory.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace meltfront::verification
{
  namespace
  {
    /** The sentence that a plugin is refused with, empty if it is taken. */
    std::string refusal(const std::string &file, const std::string &wrong = "",
                        MethodList methods = {})
    {
      setenv("MELTFRONT_WRONG_PLUGIN", wrong.c_str(), 1);
      try
      {
        add_plugin(file, methods);
      }
      catch(const cases::InputError &error)
      {
        return error.what();
      }
      return {};
    }

    void expect_in(const std::string &part, const std::string &sentence)
    {
      EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    }

    TEST(Plugins, BringTheirMethods)
    {
      setenv("MELTFRONT_WRONG_PLUGIN", "", 1);
      MethodList methods;
      add_plugin(WRONG_PLUGIN, methods);
      ASSERT_EQ(methods.size(), 1);
      EXPECT_EQ(methods[0]->name(), "idle");
      EXPECT_EQ(method_provenance(*methods[0], {}).at("plugin_hash"),
                sha256_of_file(WRONG_PLUGIN));
    }

    TEST(Plugins, AreRefusedWithTheirFileAndWhatIsWrong)
    {
      const TemporaryDirectory folder;
      const std::string text = folder.path() / "text.so";
      std::ofstream(text) << "no library\n";
      expect_in("there is no such file", refusal("/nowhere/some.so"));
      expect_in("cannot be loaded as a shared library", refusal(text));
      expect_in(text, refusal(text));
      expect_in("lacks the entry point", refusal(NO_PLUGIN));
      expect_in("was compiled with another meltfront (meltfront 0.0.9, headers "
                "0123456789ab)",
                refusal(OLD_PLUGIN));
      expect_in("its licence has run out", refusal(WRONG_PLUGIN, "throws"));
      expect_in("no std::exception", refusal(WRONG_PLUGIN, "throws a number"));
      expect_in("brings no method", refusal(WRONG_PLUGIN, "nothing"));
    }

    TEST(Plugins, NameTheirMethodsByWordsOfTheirOwn)
    {
      expect_in("brings a method 'twice', and there is one of that name already",
                refusal(WRONG_PLUGIN, "twice"));
      expect_in("its method 'two words' is to be named by letters",
                refusal(WRONG_PLUGIN, "two words"));
      expect_in("'sph.x'", refusal(WRONG_PLUGIN, "sph.x"));
      MethodList methods;
      setenv("MELTFRONT_WRONG_PLUGIN", "", 1);
      add_plugin(WRONG_PLUGIN, methods);
      expect_in("there is one of that name already",
                refusal(WRONG_PLUGIN, "", std::move(methods)));
    }
  } // namespace
} // namespace meltfront::verification
