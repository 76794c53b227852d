// UTF-8 texts of the C ABI: arguments, fixed fields, buffers that the library fills.
using System;
using System.Text;

namespace Vfit
{
    internal static unsafe class Utf8Text
    {
        /// <summary>Bytes of a text that are tried on the stack first.</summary>
        internal const int Few = 512;

        /// <summary>The text up to its end mark, or of capacity bytes.</summary>
        internal static string Read(byte* bytes, int capacity)
        {
            int length = 0;
            while (length < capacity && bytes[length] != 0) length++;
            return length == 0 ? "" : Encoding.UTF8.GetString(bytes, length);
        }

        /// <summary>Into a field of fixed size.</summary>
        internal static void Write(string text, byte* bytes, int capacity, string name)
        {
            byte[] encoded = Encode(text ?? "");
            if (encoded.Length > capacity)
                throw new ArgumentException(
                    "\"" + text + "\" is longer than " + (capacity - 1) + " bytes", name);
            for (int i = 0; i < capacity; i++) bytes[i] = i < encoded.Length ? encoded[i] : (byte)0;
        }

        /// <summary>With its end mark, for a fixed pointer; null stays null.</summary>
        internal static byte[] Encode(string text)
        {
            if (text == null) return null;
            if (text.IndexOf('\0') >= 0)
                throw new ArgumentException("a text for vfit must not contain a null character");
            var bytes = new byte[Encoding.UTF8.GetByteCount(text) + 1];
            Encoding.UTF8.GetBytes(text, 0, text.Length, bytes, 0);
            return bytes;
        }

        /// <summary>The same for an argument that must be there.</summary>
        internal static byte[] Encode(string text, string name)
        {
            if (text == null) throw new ArgumentNullException(name);
            return Encode(text);
        }
    }
}
