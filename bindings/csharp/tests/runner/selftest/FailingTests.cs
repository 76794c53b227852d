// Each assertion and constraint on a value that it must refuse: all of these tests must fail.
using System;
using System.Collections.Generic;
using System.IO;
using NUnit.Framework;

namespace Vfit.TestRunner.SelfTests
{
    [TestFixture]
    public class FailingTests
    {
        [Test]
        public void AreEqualOfNumbers()
        {
            Assert.AreEqual(1u, 2);
        }

        [Test]
        public void AreEqualOfNull()
        {
            Assert.AreEqual("", null, "with a message");
        }

        [Test]
        public void AreEqualOfTexts()
        {
            Assert.AreEqual("a \"b\"\n", "a \"c\"\n");
        }

        [Test]
        public void AreEqualOfItems()
        {
            Assert.AreEqual(new[] { 1, 2, 3 }, new[] { 1, 5, 3 });
        }

        [Test]
        public void AreEqualOfLengths()
        {
            Assert.AreEqual(new List<int> { 1, 2 }, new[] { 1 });
        }

        [Test]
        public void AreEqualWithinDelta()
        {
            Assert.AreEqual(1, 1.5, 0.25);
        }

        [Test]
        public void AreEqualWithinDeltaOfNaN()
        {
            Assert.AreEqual(1, double.NaN, 0.25);
        }

        [Test]
        public void AreNotEqual()
        {
            Assert.AreNotEqual(0, 0ul);
        }

        [Test]
        public void AreNotSame()
        {
            Assert.AreNotSame("a", "a");
        }

        [Test]
        public void CollectionAreEqual()
        {
            CollectionAssert.AreEqual(new[] { 1, 2 }, new[] { 2, 1 });
        }

        [Test]
        public void Fail()
        {
            Assert.Fail("on purpose");
        }

        [Test]
        public void Greater()
        {
            Assert.Greater(1, 1);
        }

        [Test]
        public void GreaterOrEqual()
        {
            Assert.GreaterOrEqual(1, 2);
        }

        [Test]
        public void HasCount()
        {
            Assert.That(new List<int>(), Has.Count.EqualTo(1));
        }

        [Test]
        public void HasMember()
        {
            Assert.That(new[] { "a" }, Has.Member("b"));
        }

        [Test]
        public void HasNoMember()
        {
            Assert.That(new[] { "a" }, Has.No.Member("a"));
        }

        [Test]
        public void IsAllInRange()
        {
            Assert.That(new[] { 1, 9 }, Is.All.InRange(0, 5));
        }

        [Test]
        public void IsBoth()
        {
            Assert.That(3, Is.GreaterThan(0).And.LessThan(2));
        }

        [Test]
        public void IsEither()
        {
            Assert.That(3, Is.EqualTo(1).Or.EqualTo(2));
        }

        [Test]
        public void IsEitherOrBoth()
        {
            Assert.That(3, Is.EqualTo(1).Or.EqualTo(3).And.LessThan(2));
        }

        [Test]
        public void IsEmpty()
        {
            Assert.That(new[] { 1 }, Is.Empty);
        }

        [Test]
        public void IsEqualTo()
        {
            Assert.That("a", Is.EqualTo("b"));
        }

        [Test]
        public void IsFalse()
        {
            Assert.IsFalse(true);
        }

        [Test]
        public void IsGreaterThan()
        {
            Assert.That(1, Is.GreaterThan(1));
        }

        [Test]
        public void IsInRange()
        {
            Assert.That(2.5f, Is.InRange(0f, 2f));
        }

        [Test]
        public void IsInstanceOf()
        {
            Assert.That(1, Is.InstanceOf<string>());
        }

        [Test]
        public void IsLessThan()
        {
            Assert.That(1, Is.LessThan(1));
        }

        [Test]
        public void IsNotEmpty()
        {
            Assert.That("", Is.Not.Empty);
        }

        [Test]
        public void IsNotNull()
        {
            Assert.IsNotNull(null);
        }

        [Test]
        public void IsNull()
        {
            Assert.IsNull(1);
        }

        [Test]
        public void IsOrdered()
        {
            Assert.That(new[] { 2, 1 }, Is.Ordered);
        }

        [Test]
        public void IsOrderedDescending()
        {
            Assert.That(new[] { 1, 2 }, Is.Ordered.Descending);
        }

        [Test]
        public void IsTrue()
        {
            Assert.IsTrue(false, "with a message");
        }

        [Test]
        public void Less()
        {
            Assert.Less(1, 1);
        }

        [Test]
        public void LessOrEqual()
        {
            Assert.LessOrEqual(2, 1);
        }

        [Test]
        public void StringContains()
        {
            StringAssert.Contains("x", "abc");
        }

        [Test]
        public void StringDoesNotContain()
        {
            StringAssert.DoesNotContain("b", "abc");
        }

        [Test]
        public void StringStartsWith()
        {
            StringAssert.StartsWith("b", "abc");
        }

        [Test]
        public void That()
        {
            Assert.That(false);
        }

        [Test]
        public void ThrowsADerivedType()
        {
            Assert.Throws<IOException>(ThrowDerived);
        }

        [Test]
        public void ThrowsNothing()
        {
            Assert.Throws<ArgumentException>(Nothing, "with a message");
        }

        [Test]
        public void ThrownByTheTest()
        {
            throw new InvalidOperationException("on purpose", new ArgumentException("its cause"));
        }

        private static void ThrowDerived()
        {
            throw new FileNotFoundException("on purpose");
        }

        private static void Nothing() { }
    }

    /// <summary>NaN is in no range. In NUnit 2.6 it is less than all numbers, and Less passes.</summary>
    [TestFixture]
    public class NaNTests
    {
        [Test]
        public void IsGreaterThan()
        {
            Assert.That(double.NaN, Is.GreaterThan(0));
        }

        [Test]
        public void IsInRange()
        {
            Assert.That(float.NaN, Is.InRange(0f, 1f));
        }

        [Test]
        public void Less()
        {
            Assert.Less(float.NaN, 15);
        }
    }
}
