// Tests that are skipped, by themselves or by an attribute.
using NUnit.Framework;

namespace Vfit.TestRunner.SelfTests
{
    [TestFixture]
    public class SkippedTests
    {
        [Test]
        public void ByItself()
        {
            Assert.Ignore("no \"recording\" in Größe");
        }

        [Test]
        [Ignore("by attribute")]
        public void ByAttribute()
        {
            Assert.Fail("runs");
        }

        [TestCase(1)]
        [TestCase(2)]
        public void InOneCase(int number)
        {
            if (number == 2) Assert.Ignore("not 2");
        }
    }

    [TestFixture]
    [Ignore("all of the fixture")]
    public class SkippedFixtureTests
    {
        public SkippedFixtureTests()
        {
            Assert.Fail("runs");
        }

        [Test]
        public void First() { }

        [Test]
        public void Second() { }
    }

    [TestFixture]
    public class SkippedInSetUpTests
    {
        [SetUp]
        public void SetUp()
        {
            Assert.Ignore("no device");
        }

        [Test]
        public void One()
        {
            Assert.Fail("runs");
        }
    }
}
