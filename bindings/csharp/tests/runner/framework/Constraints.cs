// Is, Has and their chains: Is.GreaterThan(0).And.LessThan(1), Is.Not.Null, Has.Count.EqualTo(1).
using System;

namespace NUnit.Framework
{
    /// <summary>A finished condition, which And and Or extend. And binds tighter than Or.</summary>
    public class Constraint
    {
        private readonly Check alternatives, last;

        internal Constraint(Check last) : this(null, last) { }

        private Constraint(Check alternatives, Check last)
        {
            this.alternatives = alternatives;
            this.last = last;
        }

        internal Check Whole
        {
            get { return alternatives == null ? last : Check.Either(alternatives, last); }
        }

        public ConstraintExpression And
        {
            get
            {
                return new ConstraintExpression(next => new Constraint(alternatives, Check.Both(last, next)));
            }
        }

        public ConstraintExpression Or
        {
            get { return new ConstraintExpression(next => new Constraint(Whole, next)); }
        }
    }

    public sealed class OrderedConstraint : Constraint
    {
        internal OrderedConstraint() : base(Check.Ordered(false)) { }

        public Constraint Descending
        {
            get { return new Constraint(Check.Ordered(true)); }
        }
    }

    /// <summary>A condition that waits for its last word.</summary>
    public sealed class ConstraintExpression
    {
        private readonly Func<Check, Constraint> complete;

        internal ConstraintExpression(Func<Check, Constraint> complete)
        {
            this.complete = complete;
        }

        public ConstraintExpression Not
        {
            get { return new ConstraintExpression(c => complete(Check.Not(c))); }
        }

        public ConstraintExpression All
        {
            get { return new ConstraintExpression(c => complete(Check.All(c))); }
        }

        internal ConstraintExpression Count
        {
            get { return new ConstraintExpression(c => complete(Check.Property("Count", c))); }
        }

        public Constraint Null
        {
            get { return complete(Check.Null()); }
        }

        public Constraint Empty
        {
            get { return complete(Check.Empty()); }
        }

        public Constraint EqualTo(object expected)
        {
            return complete(Check.Equal(expected));
        }

        public Constraint GreaterThan(object bound)
        {
            return complete(Check.Greater(bound));
        }

        public Constraint LessThan(object bound)
        {
            return complete(Check.Less(bound));
        }

        public Constraint InRange<T>(T from, T to) where T : IComparable<T>
        {
            return complete(Check.InRange(from, to));
        }

        public Constraint InstanceOf<T>()
        {
            return complete(Check.InstanceOf(typeof(T)));
        }

        public Constraint Member(object item)
        {
            return complete(Check.Member(item));
        }
    }

    public static class Is
    {
        private static ConstraintExpression Start
        {
            get { return new ConstraintExpression(c => new Constraint(c)); }
        }

        public static ConstraintExpression Not
        {
            get { return Start.Not; }
        }

        public static ConstraintExpression All
        {
            get { return Start.All; }
        }

        public static Constraint Null
        {
            get { return Start.Null; }
        }

        public static Constraint Empty
        {
            get { return Start.Empty; }
        }

        public static OrderedConstraint Ordered
        {
            get { return new OrderedConstraint(); }
        }

        public static Constraint EqualTo(object expected)
        {
            return Start.EqualTo(expected);
        }

        public static Constraint GreaterThan(object bound)
        {
            return Start.GreaterThan(bound);
        }

        public static Constraint LessThan(object bound)
        {
            return Start.LessThan(bound);
        }

        public static Constraint InRange<T>(T from, T to) where T : IComparable<T>
        {
            return Start.InRange(from, to);
        }

        public static Constraint InstanceOf<T>()
        {
            return Start.InstanceOf<T>();
        }
    }

    public static class Has
    {
        private static ConstraintExpression Start
        {
            get { return new ConstraintExpression(c => new Constraint(c)); }
        }

        public static ConstraintExpression No
        {
            get { return Start.Not; }
        }

        public static ConstraintExpression Count
        {
            get { return Start.Count; }
        }

        public static Constraint Member(object item)
        {
            return Start.Member(item);
        }
    }
}
