// Values as failure messages print them: invariant numbers, quoted strings, the first items of a sequence.
using System;
using System.Collections;
using System.Collections.Generic;
using System.Globalization;
using System.Text;

namespace NUnit.Framework
{
    internal static class Text
    {
        private const int MaxItems = 10, MaxCharacters = 400;

        public static string Of(object value)
        {
            if (value == null) return "null";
            if (value is string text) return Quoted(text, '"');
            if (value is bool flag) return flag ? "true" : "false";
            if (value is char) return Quoted(value.ToString(), '\'');
            if (value is float single) return single.ToString("R", CultureInfo.InvariantCulture);
            if (value is double number) return number.ToString("R", CultureInfo.InvariantCulture);
            if (value is IEnumerable sequence) return Items(sequence);
            if (value is IFormattable other) return other.ToString(null, CultureInfo.InvariantCulture);
            return value.ToString();
        }

        private static string Items(IEnumerable sequence)
        {
            var items = new List<string>();
            int count = 0;
            foreach (object item in sequence)
                if (count++ < MaxItems) items.Add(Of(item));
            string shown = string.Join(", ", items.ToArray());
            return "[" + shown + (count > MaxItems ? ", ... " + count + " items" : "") + "]";
        }

        private static string Quoted(string text, char quote)
        {
            var quoted = new StringBuilder();
            quoted.Append(quote);
            foreach (char c in text.Length > MaxCharacters ? text.Substring(0, MaxCharacters) : text)
            {
                if (c == quote || c == '\\') quoted.Append('\\').Append(c);
                else if (c == '\n') quoted.Append("\\n");
                else if (char.IsControl(c)) quoted.Append("\\u").Append(((int)c).ToString("x4"));
                else quoted.Append(c);
            }
            quoted.Append(quote);
            if (text.Length > MaxCharacters) quoted.Append("... ").Append(text.Length).Append(" characters");
            return quoted.ToString();
        }
    }
}
