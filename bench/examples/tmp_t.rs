//! tmp
use epas_bench::calibrate::{
    checks, columns,
    signals::{Motion, RowSettings, Rows, SmoothingSettings},
};
use std::path::Path;
use std::time::Instant;
fn main() {
    for a in std::env::args().skip(1) {
        let t = Instant::now();
        let r = columns::read(Path::new(&a), None);
        println!("read {:?}", t.elapsed());
        match r {
            Err(e) => {
                e.report();
            }
            Ok(tr) => {
                println!(
                    "n {} step {} res {:e} repairs {:?} ignored {:?} coord {:?}",
                    tr.len(),
                    tr.step,
                    tr.resolution,
                    tr.repairs,
                    tr.ignored,
                    tr.coordinate
                );
                let t = Instant::now();
                match Motion::of(&tr, &SmoothingSettings::default()) {
                    Err(e) => {
                        e.report();
                    }
                    Ok(m) => {
                        println!("motion {:?} noise {:?}", t.elapsed(), m.noise);
                        let t = Instant::now();
                        match checks::examine(&tr, &m) {
                            Err(e) => {
                                e.report();
                            }
                            Ok(f) => {
                                for x in f {
                                    println!("  {:?} {:.4} {}", x.kind, x.figure, x.message);
                                }
                            }
                        }
                        println!("checks {:?}", t.elapsed());
                        let rows = Rows::new(tr.step, &RowSettings::default()).unwrap();
                        let t = Instant::now();
                        let y = rows.of(&tr.effort);
                        println!("rows {} {:?}", y.len(), t.elapsed());
                    }
                }
            }
        }
    }
}
