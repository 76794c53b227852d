// Each assertion and constraint on values that it must accept.
using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Vfit.TestRunner.SelfTests
{
    [TestFixture]
    public class PassingTests
    {
        private enum Color
        {
            Red, Green
        }

        [Test]
        public void NumbersOfAllTypesAreEqualByValue()
        {
            Assert.AreEqual(1u, 1);
            Assert.AreEqual((byte)7, 7L);
            Assert.AreEqual(120, 120f);
            Assert.AreEqual(ulong.MaxValue, ulong.MaxValue);
            Assert.AreEqual(2.5, 2.5f);
            Assert.AreEqual(double.NaN, double.NaN);
            Assert.AreNotEqual(0.1, 0.1f);
            Assert.AreNotEqual(long.MaxValue, long.MaxValue - 1);
        }

        [Test]
        public void NumbersAreEqualWithinADelta()
        {
            Assert.AreEqual(1, 1.01f, 0.02f);
            Assert.AreEqual(double.NaN, double.NaN, 0.1);
            Assert.AreEqual(double.PositiveInfinity, double.PositiveInfinity, 0.1);
        }

        [Test]
        public void EnumeratorsAreNoNumbers()
        {
            Assert.AreEqual(Color.Green, Color.Green);
            Assert.AreNotEqual(Color.Green, 1);
            Assert.AreNotEqual(Color.Green, Color.Red);
        }

        [Test]
        public void SequencesAreEqualByItems()
        {
            Assert.AreEqual(new[] { 1, 2 }, new List<long> { 1, 2 });
            Assert.AreEqual(new[] { "a", null }, new[] { "a", null });
            Assert.AreEqual(new[] { new[] { 1 }, new[] { 2, 3 } }, new[] { new[] { 1 }, new[] { 2, 3 } });
            Assert.AreNotEqual(new[,] { { 1, 2 } }, new[,] { { 1 }, { 2 } });
            CollectionAssert.AreEqual(new ushort[] { 1, 2 }, new ushort[] { 1, 2 });
        }

        [Test]
        public void ConditionsNullAndIdentity()
        {
            Assert.That(true);
            Assert.IsTrue(true);
            Assert.IsFalse(false);
            Assert.IsNull(null);
            Assert.IsNotNull("");
            Assert.AreEqual(null, null);
            Assert.AreNotSame(new object(), new object());
        }

        [Test]
        public void BoundsOfMixedNumbers()
        {
            Assert.Greater(2u, 1.5f);
            Assert.GreaterOrEqual(2L, 2);
            Assert.Less((ushort)1, 2u);
            Assert.LessOrEqual(2, 2.0);
            Assert.Greater("b", "a");
        }

        [Test]
        public void ConstraintsOfValues()
        {
            Assert.That(0.05f, Is.GreaterThan(0).And.LessThan(0.1f));
            Assert.That(5, Is.InRange(5, 6).And.InRange(4, 5));
            Assert.That(3, Is.EqualTo(2).Or.EqualTo(3));
            Assert.That(1, Is.EqualTo(1).Or.EqualTo(2).And.EqualTo(3), "And binds tighter than Or");
            Assert.That("", Is.Not.Null);
            Assert.That(null, Is.Null);
            Assert.That(3, Is.Not.EqualTo(2).And.Not.EqualTo(4));
            Assert.That(new ArgumentException(), Is.InstanceOf<Exception>().Or.InstanceOf<string>());
        }

        [Test]
        public void ConstraintsOfSequences()
        {
            Assert.That(new[] { 3, 2, 2 }, Is.Ordered.Descending);
            Assert.That(new[] { 1, 2, 2 }, Is.Ordered);
            Assert.That(new[] { 1, 2 }, Is.All.InRange(1, 2));
            Assert.That(new int[0], Is.Empty);
            Assert.That("a", Is.Not.Empty);
            Assert.That(new[] { "a", "b" }, Has.Member("b"));
            Assert.That(new[] { "a", "b" }, Has.No.Member("c"));
            Assert.That(new List<int> { 7 }, Has.Count.EqualTo(1));
        }

        [Test]
        public void Texts()
        {
            StringAssert.Contains("b", "abc");
            StringAssert.DoesNotContain("x", "abc");
            StringAssert.StartsWith("ab", "abc");
        }

        [Test]
        public void ThrownExceptionsAreReturned()
        {
            Assert.AreEqual("why", Assert.Throws<InvalidOperationException>(Throw).Message);
        }

        private static void Throw()
        {
            throw new InvalidOperationException("why");
        }
    }
}
