// SetUp, TearDown and the fixture's object: how often, in which order, and what happens if one of them fails.
using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Vfit.TestRunner.SelfTests
{
    public abstract class LifeBase
    {
        protected static readonly List<string> log = new List<string>();

        [SetUp]
        public void BaseSetUp()
        {
            log.Add("base up");
        }

        [TearDown]
        public void BaseTearDown()
        {
            log.Add("base down");
        }

        [SetUp]
        public virtual void Overridden()
        {
            Assert.Fail("overridden");
        }

        [Test]
        public void Inherited()
        {
            log.Add("inherited");
        }
    }

    /// <summary>Tests run in the order of their names; the last one looks at what happened.</summary>
    [TestFixture]
    public sealed class LifeTests : LifeBase, IDisposable
    {
        public static int Disposed;

        private static int made;
        private int tests;

        public LifeTests()
        {
            made++;
        }

        public void Dispose()
        {
            Disposed++;
        }

        [SetUp]
        public void SetUp()
        {
            log.Add("up");
            tests++;
        }

        [TearDown]
        public void TearDown()
        {
            log.Add("down");
        }

        public override void Overridden() { }

        [Test]
        public void AFirst()
        {
            Assert.AreEqual(new[] { "base up", "up" }, log);
        }

        [TestCase(1, "a")]
        [TestCase(2, null)]
        public void Cases(int number, string text)
        {
            log.Add("case " + number + text);
        }

        [Test]
        public void ZLast()
        {
            Assert.AreEqual(new[]
            {
                "base up", "up", "down", "base down",
                "base up", "up", "case 1a", "down", "base down",
                "base up", "up", "case 2", "down", "base down",
                "base up", "up", "inherited", "down", "base down",
                "base up", "up"
            }, log);
            Assert.AreEqual(1, made);
            Assert.AreEqual(5, tests);
        }
    }

    [TestFixture]
    public class LifeTestsAfterwards
    {
        [Test]
        public void TheFixtureWasDisposed()
        {
            Assert.AreEqual(1, LifeTests.Disposed);
        }

        [Test]
        public void AFailedSetUpRunsTearDownButNotTheTest()
        {
            Assert.AreEqual(0, FailingSetUpTests.Tests);
            Assert.AreEqual(1, FailingSetUpTests.TearDowns);
        }
    }

    [TestFixture]
    public class FailingConstructorTests
    {
        public FailingConstructorTests()
        {
            throw new InvalidOperationException("on purpose");
        }

        [Test]
        public void FailsFirst() { }

        [Test]
        public void FailsSecond() { }
    }

    [TestFixture]
    public class FailingSetUpTests
    {
        public static int Tests, TearDowns;

        [SetUp]
        public void SetUp()
        {
            throw new InvalidOperationException("on purpose");
        }

        [TearDown]
        public void TearDown()
        {
            TearDowns++;
        }

        [Test]
        public void Fails()
        {
            Tests++;
        }
    }

    [TestFixture]
    public class FailingTearDownTests
    {
        [TearDown]
        public void TearDown()
        {
            throw new InvalidOperationException("on purpose");
        }

        [Test]
        public void FailsAfterPassing() { }

        [Test]
        public void FailsTwice()
        {
            Assert.Fail("the test itself");
        }

        [Test]
        public void FailsThoughIgnored()
        {
            Assert.Ignore("ignored");
        }
    }

    [TestFixture]
    public class TearDownAfterFailureTests
    {
        private static int tearDowns;

        [TearDown]
        public void TearDown()
        {
            tearDowns++;
        }

        [Test]
        public void AFails()
        {
            Assert.Fail("on purpose");
        }

        [Test]
        public void BPasses()
        {
            Assert.AreEqual(1, tearDowns);
        }
    }
}
