// Tests that cannot run are failures, not silence.
using NUnit.Framework;

namespace Vfit.TestRunner.SelfTests
{
    [TestFixture]
    public class UnrunnableTests
    {
        [Test]
        private void FailsAsPrivate() { }

        [Test]
        public int FailsAsItReturnsANumber()
        {
            return 0;
        }

        [Test]
        public void FailsAsItWantsAnArgument(int number) { }

        [TestCase(1, 2)]
        public void FailsAsItGetsTooMuch(int number) { }

        [TestCase("a")]
        public void FailsAsItGetsAnotherType(int number) { }

        [Test]
        public void Passes() { }
    }

    [TestFixture]
    public class PrivateSetUpTests
    {
        [SetUp]
        private void SetUp() { }

        [Test]
        public void Fails() { }
    }

    public class WithoutAttributeTests
    {
        [Test]
        public void Passes() { }

        public class Nested
        {
            [Test]
            public void Passes() { }
        }
    }

    public static class StaticTests
    {
        [Test]
        public static void Passes() { }
    }

    [TestFixture]
    internal class InternalTests
    {
        [Test]
        public void Passes() { }
    }

    [TestFixture]
    public class GenericTests<T>
    {
        [Test]
        public void Fails() { }
    }
}
