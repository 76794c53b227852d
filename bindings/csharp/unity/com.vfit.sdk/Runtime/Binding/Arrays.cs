// Arrays of which the first items are given to the library.
using System;

namespace Vfit
{
    internal static class Arrays
    {
        internal static void Check(Array array, int count, string name)
        {
            if (array == null) throw new ArgumentNullException(name);
            if (count < 0 || count > array.Length)
                throw new ArgumentOutOfRangeException(
                    name, "count " + count + " of " + array.Length + " items");
        }
    }
}
