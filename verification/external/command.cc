#include <cases/error.h>
#include <verification/external/command.h>
#include <verification/external/program.h>
#include <verification/external/protocol.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string_view>

namespace meltfront::verification::external
{
  namespace
  {
    using nlohmann::json;

    constexpr std::string_view folder_word = "{folder}", answer_word = "{answer}";

    /** A number, a word, or several with commas. */
    std::string text_of(const json &value, const std::string &pointer)
    {
      if(value.is_string())
        return value.get<std::string>();
      if(!value.is_structured())
        return value.dump();
      std::string text;
      for(const json &one : value)
      {
        if(value.is_object() || one.is_structured())
          throw cases::InputError(fmt::format(
              "the command asks for {{{}}}, which is no value", quoted(pointer)));
        text += (text.empty() ? "" : ",") + text_of(one, pointer);
      }
      return text;
    }

    /** @param place a pointer, with what stands for nothing behind a question mark */
    std::string value_at(const std::string &place, const json &request)
    {
      const std::size_t mark = std::min(place.find('?'), place.size());
      const std::string pointer = place.substr(0, mark);
      const json *found = nullptr;
      try
      {
        found = &request.at(json::json_pointer(pointer));
      }
      catch(const json::exception &)
      {
        if(mark < place.size())
          return place.substr(mark + 1);
        throw cases::InputError(
            fmt::format("the command asks for {{{}}}, and the request has no such value",
                        quoted(pointer)));
      }
      return text_of(*found, pointer);
    }

    std::string with_values(const std::string &word, const json &request)
    {
      static const std::regex in_braces(R"(\{(request|answer|/[^{}]*)\})");
      std::string result;
      auto rest = word.cbegin();
      for(std::sregex_iterator match(word.begin(), word.end(), in_braces), none;
          match != none; ++match)
      {
        result.append(rest, (*match)[0].first);
        const std::string what = (*match)[1];
        result += what == "request"  ? request_file
                  : what == "answer" ? answer_file
                                     : value_at(what, request);
        rest = (*match)[0].second;
      }
      return result.append(rest, word.cend());
    }

    bool can_be_run(const std::filesystem::path &path)
    {
      return std::filesystem::is_regular_file(path) && access(path.c_str(), X_OK) == 0;
    }
  } // namespace

  std::vector<std::string> words_of(const std::string &command)
  {
    std::vector<std::string> words;
    bool within = false;
    char quote = 0;
    for(const char c : command)
    {
      const bool blank = c == ' ' || c == '\t' || c == '\n';
      if(quote == 0 && blank)
      {
        within = false;
        continue;
      }
      if(!within)
        words.emplace_back();
      within = true;
      if(c == quote)
        quote = 0;
      else if(quote == 0 && (c == '\'' || c == '"'))
        quote = c;
      else
        words.back() += c;
    }
    if(quote != 0)
      throw cases::InputError(fmt::format(
          "the command has a quote {} without its end: {}", quote, quoted(command)));
    if(words.empty() || words.front().empty())
      throw cases::InputError("the command has no words");
    return words;
  }

  bool names_answer(const std::vector<std::string> &words)
  {
    return std::ranges::any_of(words, [](const std::string &word)
                               { return word.find(answer_word) != std::string::npos; });
  }

  std::vector<std::string> with_folder(std::vector<std::string> words,
                                       const std::string &folder)
  {
    for(std::string &word : words)
      for(std::size_t at = word.find(folder_word); at != std::string::npos;
          at = word.find(folder_word, at + folder.size()))
        word.replace(at, folder_word.size(), folder);
    return words;
  }

  std::vector<std::string> filled_in(std::vector<std::string> words, const json &request)
  {
    for(std::string &word : words)
      word = with_values(word, request);
    return words;
  }

  std::string find_program(const std::string &word)
  {
    if(word.find('/') != std::string::npos)
    {
      if(!can_be_run(word))
        throw cases::Refusal(
            fmt::format("'{}' is no program that can be run", quoted(word)));
      return word;
    }
    const char *const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for(std::string folder; std::getline(folders, folder, ':');)
      if(const auto file = std::filesystem::path(folder) / word; can_be_run(file))
        return file;
    throw cases::Refusal(
        fmt::format("there is no program '{}' on this machine (PATH)", quoted(word)));
  }
} // namespace meltfront::verification::external
