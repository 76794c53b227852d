// Errors of the library as an exception; news (results above 0) are no errors and are returned.
using System;

namespace Vfit
{
    /// <summary>A call of the library failed; the message is the library's own sentence.</summary>
    public sealed class VfitException : Exception
    {
        public Result Code { get; private set; }

        public VfitException(Result code, string message) : base(message)
        {
            Code = code;
        }

        /// <summary>
        /// Returns success and news. Must run on the thread of the call that gave the result.
        /// </summary>
        internal static Result Check(Result result)
        {
            if (result < 0) throw Last(result);
            return result;
        }

        private static VfitException Last(Result result)
        {
            string message = Calls.LastError();
            return new VfitException(result, message.Length > 0 ? message : Library.ResultName(result));
        }
    }
}
