//! The Pareto front of cost and error, and observed orders of convergence.

/// Indices of the points (cost, error) that no other point beats in both, by cost. Points that are not finite are left out.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len())
        .filter(|&i| points[i].0.is_finite() && points[i].1.is_finite())
        .collect();
    order.sort_by(|&a, &b| {
        let by_cost = points[a].0.total_cmp(&points[b].0);
        by_cost.then(points[a].1.total_cmp(&points[b].1))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i].1 < least;
        least = least.min(points[i].1);
        better
    });
    order
}

/// Slope of ln(error) over ln(step) by least squares.
pub fn observed_order(errors: &[[f64; 2]]) -> f64 {
    let logs: Vec<[f64; 2]> = errors
        .iter()
        .filter(|[step, error]| *step > 0.0 && *error > 0.0)
        .map(|pair| pair.map(f64::ln))
        .collect();
    let count = logs.len() as f64;
    let mean = |axis: usize| logs.iter().map(|pair| pair[axis]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let above: f64 = logs.iter().map(|pair| (pair[0] - x) * (pair[1] - y)).sum();
    let below: f64 = logs.iter().map(|pair| (pair[0] - x).powi(2)).sum();
    above / below
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_is_what_nothing_beats() {
        let points = [
            (1.0, 5.0),
            (2.0, 6.0),
            (2.0, 3.0),
            (3.0, 3.0),
            (4.0, 1.0),
            (0.5, f64::NAN),
        ];
        assert_eq!(front(&points), [0, 2, 4]);
    }

    #[test]
    fn an_order_is_the_power() {
        let errors = [0.1, 0.05, 0.02].map(|h: f64| [h, 3.0 * h.powi(2)]);
        assert!((observed_order(&errors) - 2.0).abs() < 1e-12);
    }
}
