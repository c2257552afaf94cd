#include <cases/case_file/criterion_parser.h>
#include <cases/case_file/prm_scan.h>
#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    /** Reads a sentence from left to right. */
    class Cursor
    {
    public:
      explicit Cursor(const std::string &text)
        : text(text)
      {
      }

      /** Step over a piece of text if it comes next; a word must end there. */
      bool take(const std::string &piece)
      {
        skip_blanks();
        if(text.compare(at, piece.size(), piece) != 0)
          return false;
        const std::size_t after = at + piece.size();
        if(in_word(piece.back()) && after < text.size() && in_word(text[after]))
          return false;
        at = after;
        return true;
      }

      void expect(const std::string &piece)
      {
        if(!take(piece))
          fail(fmt::format("'{}'", piece));
      }

      std::string word(const char *what)
      {
        skip_blanks();
        const std::size_t begin = at;
        while(at < text.size() && in_word(text[at]))
          ++at;
        if(at == begin)
          fail(what);
        return text.substr(begin, at - begin);
      }

      /** What stands before a character, which is stepped over. */
      std::string up_to(char mark, const char *what)
      {
        const std::size_t found = text.find(mark, at);
        const std::string piece
            = found == std::string::npos ? "" : trimmed(text.substr(at, found - at));
        if(piece.empty())
          fail(what);
        at = found + 1;
        return piece;
      }

      double number()
      {
        skip_blanks();
        double value = 0;
        const char *begin = text.data() + at;
        // The first point of `29..35` is not one of the number.
        const std::size_t last = std::min(text.find("..", at), text.size());
        const auto [end, error] = std::from_chars(begin, text.data() + last, value);
        if(error != std::errc() || !std::isfinite(value))
          fail("a number");
        at += end - begin;
        return value;
      }

      int count()
      {
        skip_blanks();
        int value = 0;
        const char *begin = text.data() + at;
        const auto [end, error]
            = std::from_chars(begin, text.data() + text.size(), value);
        if(error != std::errc() || value < 1)
          fail("a positive integer");
        at += end - begin;
        return value;
      }

      bool at_end()
      {
        skip_blanks();
        return at == text.size();
      }

      [[noreturn]] void fail(const std::string &wanted) const
      {
        throw InputError(fmt::format(
            "'{}' cannot be read: {} is wanted {}", quotable(text), wanted,
            at < text.size() ? fmt::format("before '{}'", quotable(text.substr(at)))
                             : "at its end"));
      }

    private:
      static bool in_word(char c)
      {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
      }

      void skip_blanks()
      {
        while(at < text.size() && (text[at] == ' ' || text[at] == '\t'))
          ++at;
      }

      const std::string &text;
      std::size_t at = 0;
    };

    void read_bounds(Cursor &cursor, Criterion &criterion)
    {
      if(cursor.take("<="))
        criterion.upper = cursor.number();
      else if(cursor.take(">="))
        criterion.lower = cursor.number();
      else if(cursor.take("in"))
      {
        criterion.lower = cursor.number();
        cursor.expect("..");
        criterion.upper = cursor.number();
      }
      else if(cursor.take("within"))
      {
        const double share = cursor.number() / 100;
        cursor.expect("%");
        cursor.expect("of");
        const double value = cursor.number();
        criterion.lower = value - share * std::abs(value);
        criterion.upper = value + share * std::abs(value);
      }
      else
        cursor.fail("'<=', '>=', 'in' or 'within'");
      if(criterion.lower > criterion.upper)
        throw InputError(
            fmt::format("'{}' can never hold: its lower bound exceeds the upper one",
                        quotable(criterion.text)));
    }

    int read_n(Cursor &cursor)
    {
      cursor.expect("at");
      cursor.expect("n");
      cursor.expect("=");
      return cursor.count();
    }

    /** `over n=20..50`, if it comes next. */
    void read_rows(Cursor &cursor, Criterion &criterion)
    {
      if(!cursor.take("over"))
        return;
      cursor.expect("n");
      cursor.expect("=");
      criterion.n_from = cursor.count();
      cursor.expect("..");
      criterion.n_to = cursor.count();
      if(criterion.n_from >= criterion.n_to)
        throw InputError(fmt::format("'{}' takes no rows: n must run upwards",
                                     quotable(criterion.text)));
    }

    /** Runs of several labels have a worst value, but no order and no mean. */
    void check_any_value(const Criterion &criterion)
    {
      if(criterion.statistic == Statistic::worst)
        return;
      const std::size_t open
          = std::min(criterion.method.find('['), criterion.method.size());
      for(const std::string &option : split_list(criterion.method.substr(open), ','))
        if(const std::size_t equals = option.find('=');
           equals != std::string::npos
           && trimmed(option.substr(equals + 1)).starts_with('*'))
          throw InputError(
              fmt::format("'{}' cannot be judged: only 'worst QUANTITY' is that "
                          "of any value (*) of an option",
                          quotable(criterion.text)));
    }

    void check_length(const std::string &text)
    {
      constexpr std::size_t longest = 1000;
      if(text.size() > longest)
        throw InputError(fmt::format("is longer than {} characters", longest));
    }
  } // namespace

  std::string parse_label(const std::string &text)
  {
    check_length(text);
    const std::string label = trimmed(text);
    const auto is_word = [](const std::string &word)
    { return !word.empty() && word.find_first_of("[]=, \t") == std::string::npos; };
    const std::size_t open = std::min(label.find('['), label.size());
    bool valid = is_word(trimmed(label.substr(0, open)));
    if(open < label.size())
    {
      valid = valid && label.back() == ']';
      for(const std::string &option :
          split_list(label.substr(open + 1, label.size() - open - 2), ','))
      {
        const std::size_t equals = std::min(option.find('='), option.size());
        valid = valid && is_word(trimmed(option.substr(0, equals)))
                && equals < option.size() && is_word(trimmed(option.substr(equals + 1)));
      }
    }
    if(!valid)
      throw InputError(fmt::format(
          "'{}' is not a label: METHOD or METHOD[KEY=VALUE,KEY=VALUE]", quotable(label)));
    return label;
  }

  Criterion parse_criterion(const std::string &text)
  {
    check_length(text);
    Criterion criterion;
    criterion.text = text;
    Cursor cursor(text);
    const std::string label = cursor.up_to(':', "'METHOD:'");
    criterion.method = label == any_method ? label : parse_label(label);
    if(cursor.take("fails"))
    {
      criterion.statistic = Statistic::failure;
      criterion.quantity = "failure";
      criterion.n = read_n(cursor);
      criterion.lower = criterion.upper = 1;
      if(!cursor.at_end())
        cursor.fail("the end");
      return criterion;
    }
    if(cursor.take("order of"))
      criterion.statistic = Statistic::order;
    else if(cursor.take("worst"))
      criterion.statistic = Statistic::worst;
    else if(cursor.take("median"))
      criterion.statistic = Statistic::median;
    check_any_value(criterion);
    criterion.quantity = cursor.word("a quantity");
    if(criterion.statistic == Statistic::value
       || criterion.statistic == Statistic::median)
      criterion.n = read_n(cursor);
    else
      read_rows(cursor, criterion);
    read_bounds(cursor, criterion);
    if(cursor.take(";"))
    {
      const std::string tail = "expected failure:";
      cursor.expect(tail);
      criterion.expected_failure = trimmed(text.substr(text.find(tail) + tail.size()));
      if(criterion.expected_failure.empty())
        throw InputError("names an expected failure without saying what it is");
    }
    else if(!cursor.at_end())
      cursor.fail("'; expected failure:' or the end");
    return criterion;
  }

  PrintedValue parse_printed_value(const std::string &text, const std::string &paper)
  {
    check_length(text);
    PrintedValue value;
    value.source = paper;
    Cursor cursor(text);
    value.method = cursor.up_to(':', "'METHOD:'");
    value.quantity = cursor.word("a quantity");
    value.n = read_n(cursor);
    cursor.expect("=");
    value.value = cursor.number();
    if(cursor.take("("))
    {
      const std::string table = cursor.up_to(')', "'TABLE)'");
      value.source += (paper.empty() ? "" : ", ") + table;
    }
    if(!cursor.at_end())
      cursor.fail("'(TABLE)' or the end");
    return value;
  }
} // namespace meltfront::cases
