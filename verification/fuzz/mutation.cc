#include <verification/fuzz/mutation.h>

#include <array>
#include <cctype>
#include <string_view>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::array<std::string_view, 18> hostile_numbers{
        "0",          "-1",    "1e308", "-1e308", "1e-320",
        "nan",        "inf",   "-inf",  "1e999",  "99999999999999999999",
        "2147483648", "0x10",  "1,5",   "1 2",    "",
        "1e",         "0.1 m", "5 km"};
    constexpr std::array<std::string_view, 16> hostile_words{
        "end",      "subsection", "set",     "include",  "=",   "#",
        "\\",       "\t",         "x^x",     "sqrt(-1)", "1/0", "((((((((((",
        "\xff\xfe", "\xc3\xa9",   "${HOME}", "if(x>0,t,"};

    class Hand
    {
    public:
      explicit Hand(std::mt19937_64 &random)
        : random(random)
      {
      }

      /** Less than `end`, which is positive. */
      std::size_t below(std::size_t end)
      {
        return static_cast<std::size_t>(random() % end);
      }

      template <typename Choices>
      const auto &one_of(const Choices &choices)
      {
        return choices[below(choices.size())];
      }

    private:
      std::mt19937_64 &random;
    };

    /** Begin and length of a line, its end included. */
    std::pair<std::size_t, std::size_t> line_at(const std::string &text,
                                                std::size_t place)
    {
      const std::size_t before
          = place > 0 ? text.rfind('\n', place - 1) : std::string::npos,
          after = text.find('\n', place);
      const std::size_t begin = before == std::string::npos ? 0 : before + 1,
                        end = after == std::string::npos ? text.size() : after + 1;
      return {begin, end - begin};
    }

    void replace_number(std::string &text, Hand &hand)
    {
      const std::size_t digit = text.find_first_of("0123456789", hand.below(text.size()));
      if(digit == std::string::npos)
        return;
      std::size_t end = digit;
      while(end < text.size()
            && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '.'))
        ++end;
      text.replace(digit, end - digit, hand.one_of(hostile_numbers));
    }

    void mutate(std::string &text, const std::vector<std::string> &others, Hand &hand)
    {
      if(text.empty())
        return;
      constexpr std::size_t longest_piece = 64;
      const std::size_t place = hand.below(text.size());
      const std::size_t length = 1 + hand.below(longest_piece);
      const auto [line, line_length] = line_at(text, place);
      switch(hand.below(9))
      {
      case 0:
        text[place] = static_cast<char>(text[place] ^ (1 << hand.below(8)));
        break;
      case 1:
        text.erase(place, length);
        break;
      case 2:
        text.insert(place, text.substr(hand.below(text.size()), length));
        break;
      case 3:
        text.resize(place);
        break;
      case 4:
        text.erase(line, line_length);
        break;
      case 5:
      {
        const std::string moved = text.substr(line, line_length);
        text.insert(line_at(text, hand.below(text.size())).first, moved);
        break;
      }
      case 6:
      {
        const std::string &other = hand.one_of(others);
        const auto [from, of_length] = line_at(other, hand.below(other.size()));
        text.insert(line, other.substr(from, of_length));
        break;
      }
      case 7:
        replace_number(text, hand);
        break;
      default:
        text.insert(place, hand.one_of(hostile_words));
      }
    }
  } // namespace

  std::string mutated(const std::string &text, const std::vector<std::string> &others,
                      std::mt19937_64 &random)
  {
    constexpr std::size_t most_mutations = 6;
    Hand hand(random);
    std::string result = text;
    for(std::size_t k = 1 + hand.below(most_mutations); k > 0; --k)
      mutate(result, others, hand);
    return result;
  }
} // namespace meltfront::verification
